"""The same bits, whatever runs a scene."""

import ladder
import world

LONG = False
SCENES = {"managed_ice": 6.0, "level_ice": 6.0}
WAYS = [("1 thread", {}), ("2 threads", {"threads": 2}), ("5 threads", {"threads": 5}),
        ("baseline instructions", {"isa": "baseline"}), ("AVX2", {"isa": "avx2"}), ("AVX-512", {"isa": "avx512"})]


def hash_of(path, end, options):
    """Of the state at the end; or that this processor lacks the instructions."""
    try:
        with world.World(path, run__duration=end, run__transient=0, **options) as w:
            w.run(end)
            return w.hash
    except world.fram.UsageError as why:
        if why.key != "isa":
            raise
        return f"not on this machine ({why.message})"


def resumed(path, name, half, end):
    """Hash of a run that is stopped halfway and resumed."""
    folder = ladder.WORK / "same_bits" / name
    keys = [f"--set=run.duration={end}", "--set=run.transient=0", "--set=output.frame_interval=0"]
    ladder.answer("run", path, "-o", folder, "--force", "--quiet", "--until", half, *keys)
    return ladder.answer("resume", folder, "--quiet", "--threads", 2)["state_hash"]


def case(out):
    c = ladder.Case(
        "Bit-identical results from any number of threads, any instruction set, and after a restart",
        1,
        "Hash of the whole state after 6 s of the managed field and of level ice: threads, instruction sets, and a "
        "run that was "
        "stopped halfway and resumed.",
        "The runs themselves.",
        "Equal to the bit: the order of operations depends on the data alone.",
    )
    c.header = ["way", *SCENES]
    hashes = {}
    for scene, end in SCENES.items():
        path = ladder.ROOT / "scenes" / f"{scene}.yaml"
        for way, options in WAYS:
            hashes[way, scene] = hash_of(path, end, options)
        hashes["stopped and resumed", scene] = resumed(path, scene, end / 2, end)
    for way in [*(way for way, _ in WAYS), "stopped and resumed"]:
        c.rows.append([way, *(f"`{hashes[way, scene]}`" for scene in SCENES)])
        for scene in SCENES:
            if not hashes[way, scene].startswith("not"):
                c.check(hashes[way, scene] == hashes["1 thread", scene], f"{scene}: {way} as 1 thread")
    c.found = "gcc and clang are compared by `make test-clang`, on more scenes."
    return c
