"""A real Slurm on this machine for tests: slurmctld, munged and a few slurmd in a folder of their own, without systemd.

Needs root, and Debian's slurmctld, slurmd, slurm-client and munge (`make test-slurm` installs them)."""
import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "squeue", "scancel", "sinfo")

CONFIGURATION = """
ClusterName=fram
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmctldPort={port}
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmdSpoolDir={folder}/spool.%n
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0,bf_interval=1
ReturnToService=2
SlurmdParameters=config_overrides
SlurmdTimeout=5
KillWait=2
MinJobAge=300
"""


def is_alive(process):
    """Not one that has ended and that nobody has asked how."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def missing():
    """Why there can be no cluster here; "" when there can."""
    lacking = [p for p in PROGRAMS if not shutil.which(p)]
    if lacking:
        return "not installed: " + ", ".join(lacking) + " (make test-slurm installs Slurm)"
    return "" if os.geteuid() == 0 else "a cluster of Slurm is started as root only"


class Cluster:
    def __init__(self, nodes):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fram-slurm-"))
        self.folder.chmod(0o755)
        self.nodes = [f"n{i + 1}" for i in range(nodes)]
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))
        for name in ("state", "munge"):
            (self.folder / name).mkdir(mode=0o755)
        self.configure()
        key = self.folder / "munge" / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        munge = self.folder / "munge"
        self.call("munged", "--force", f"--key-file={key}", f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                  f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        self.call("slurmctld", "-c")
        for node in self.nodes:
            (self.folder / f"spool.{node}").mkdir()
            self.start_node(node)
        self.wait_for_nodes()

    def configure(self):
        host = socket.gethostname().split(".")[0]
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        port = port if port < 60000 else port - 5000
        text = CONFIGURATION.format(host=host, folder=self.folder, port=port)
        for i, node in enumerate(self.nodes):
            text += f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port + 1 + i} "
            text += "CPUs=1 RealMemory=2000\n"
        text += f"PartitionName=all Nodes={','.join(self.nodes)} Default=YES MaxTime=INFINITE State=UP\n"
        (self.folder / "slurm.conf").write_text(text)

    def call(self, *words):
        return subprocess.run(words, env=self.environment, check=True, capture_output=True, text=True).stdout

    def start_node(self, node):
        self.call("slurmd", "-c", "-N", node)

    def wait_for_nodes(self):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if self.call("sinfo", "-h", "-t", "idle", "-o", "%D").strip() == str(len(self.nodes)):
                return
            time.sleep(0.2)
        raise RuntimeError("the nodes do not come up: " + self.call("sinfo"))

    def stop_program(self, pid_file, number=signal.SIGKILL):
        """Until it has ended: it may still write into the folder meanwhile."""
        try:
            number_of_program = int(pid_file.read_text())
            os.kill(number_of_program, number)
        except (OSError, ValueError):
            return
        end = time.monotonic() + 30
        while is_alive(number_of_program) and time.monotonic() < end:
            time.sleep(0.02)

    def programs_with(self, *settings):
        """Numbers of the programs of this cluster that have these in their environment too."""
        wanted = {f"SLURM_CONF={self.folder}/slurm.conf".encode(), *(s.encode() for s in settings)}
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if wanted <= set((process / "environ").read_bytes().split(b"\0")):
                    yield int(process.name)
            except OSError:
                pass

    def kill_with(self, *settings):
        """All of them, until none is found: one may have started another meanwhile, and what is killed may still write
        into the folder."""
        end = time.monotonic() + 30
        while time.monotonic() < end and (found := list(self.programs_with(*settings))):
            for program in found:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(program, signal.SIGKILL)
            time.sleep(0.02)

    def kill_node(self, node):
        """The node is lost with all that runs on it."""
        self.stop_program(self.folder / f"slurmd.{node}.pid")
        self.kill_with(f"SLURMD_NODENAME={node}")

    def hide_from_node(self, node, folder, empty):
        """The node sees an empty folder in place of another."""
        self.kill_node(node)
        self.call("unshare", "-m", "sh", "-c",
                  f'mount --make-rprivate / && mount --bind "{empty}" "{folder}" && exec slurmd -c -N {node}')
        self.wait_for_nodes()

    def stop(self):
        for node in self.nodes:
            self.kill_node(node)
        self.stop_program(self.folder / "slurmctld.pid", signal.SIGTERM)
        self.stop_program(self.folder / "munge" / "pid", signal.SIGTERM)
        self.kill_with()  # slurmstepd, which watches over a job, need not know its node
        shutil.rmtree(self.folder)
