#!/usr/bin/env python3
"""The checkers of tools/ find what they are for: each breach is planted in a small house and must be named."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
# A hook of git tells its children which tree is meant.
NO_GIT = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}


class House(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="fram-house-"))
        self.addCleanup(shutil.rmtree, self.root)
        shutil.copytree(TOOLS, self.root / "tools", ignore=shutil.ignore_patterns("__pycache__"))

    def plant(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def rooms(self):
        done = subprocess.run([sys.executable, self.root / "tools/check_rooms.py"], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return done.stdout

    def objects(self, text, *flags):
        """What check_objects.py says of one file compiled with flags."""
        self.plant("object.c", text)
        rooms = self.root / "build/rooms"
        rooms.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cc", "-O2", *flags, "-c", "object.c", "-o", "object.o"], cwd=self.root, check=True)
        subprocess.run(["ar", "rcs", rooms / "libroom_base.a", "object.o"], cwd=self.root, check=True)
        done = subprocess.run([sys.executable, self.root / "tools/check_objects.py", self.root / "build"],
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return done.stdout

    def unused(self):
        done = subprocess.run([sys.executable, self.root / "tools/check_unused.py"], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return [line for line in done.stdout.splitlines() if "listed with a reason to stay" not in line]

    def test_functions_that_nothing_uses(self):
        self.plant("src/ice/floe.h", "double floe_area(int x);\nstatic inline int floe_twin(int x) { return x; }\n")
        self.plant("src/ice/floe.c", "double floe_area(int x)\n{\n    return x; /* floe_area, floe_twin */\n}\n"
                                     "static int own(void) { return 0; }\n")
        self.plant("tests/ice/test_floe.c", "double a = floe_area(1);\n")
        said = self.unused()
        self.assertEqual(len(said), 2)
        self.assertIn("nothing in src/ uses floe_area", said[0])
        self.assertIn("nothing in src/ uses floe_twin", said[1])
        self.plant("src/sim/step.c", "double b = floe_area(2) + floe_twin(3);\n")
        self.assertEqual(self.unused(), [])
        self.plant("src/ice/floe.h", "double floe_area(int x);\ndouble floe_side(int x);\n"
                                     "static inline int floe_twin(int x) { return x; }\n")
        self.plant("src/ice/floe_side.c", "double floe_side(int x)\n{\n    return x;\n}\ndouble d = floe_side(1);\n")
        self.assertEqual(self.unused(), ["src/ice/floe.h: only its own file uses floe_side: make it static"])
        self.plant("tests/ice/test_side.c", "double a = floe_side(1);\n")
        self.assertEqual(self.unused(), [])
        self.plant("include/fram/ice.h", "FRAM_API int fram_ice_area(void);\n")
        self.assertIn("fram_ice_area is public and no C test calls it", self.unused()[0])
        self.plant("tests/api/test_ice.c", "int c = fram_ice_area();\n")
        self.assertEqual(self.unused(), [])

    def test_includes_of_which_nothing_is_used(self):
        gives = {"function": ("int floe_area(int x);", "x = floe_area(1)"),
                 "macro": ("#define FLOE_MOST 3", "x = FLOE_MOST"),
                 "typedef": ("typedef ARRAY(double) floe_array;", "floe_array *x"),
                 "struct": ("struct floe { int a; };", "struct floe *x"),
                 "type of functions": ("typedef double (*floe_look)(int x);", "floe_look x"),
                 "enumerator": ("typedef enum floe_kind { FLOE_WIDE = 1, FLOE_LONG } floe_kind;", "x = FLOE_LONG"),
                 "made by a macro": ("KERNEL_DECLARE(void, floe_move, (int *at, double dt));", "RUN(floe_move)(x, 1)"),
                 "data": ("extern const int floe_names[3];", "x = floe_names[0]"),
                 "member alone": ("struct floe { int deep; };", "x = known(1)->deep")}
        self.plant("src/ice/other.h", "struct floe *known(int x);\n")
        for kind, (head, use) in gives.items():
            with self.subTest(kind):
                self.plant("src/ice/floe.h", head + "\n")
                text = '#include "ice/floe.h"\n#include "ice/other.h"\nstatic void f(void) { %s; known(1); }\n'
                self.plant("src/ice/user.c", text % use)
                self.assertEqual([line for line in self.unused() if "included" in line], [])
                self.plant("src/ice/user.c", text % "/* floe_area, FLOE_MOST */ int x")
                self.assertEqual([line for line in self.unused() if "included" in line],
                                 ['src/ice/user.c: "ice/floe.h" is included and nothing of it used: delete it, or '
                                  'include what is used instead'])
        # Who has a header by another one does not need it for the members of its structs.
        self.plant("src/ice/other.h", '#include "ice/floe.h"\nstruct floe *known(int x);\n')
        self.plant("src/ice/user.c", text % "x = known(1)->deep")
        self.assertEqual(len([line for line in self.unused() if '"ice/floe.h" is included' in line]), 1)
        # Its own header a file includes whatever it gives, and headers of others are not Fram's.
        self.plant("src/ice/user.c", '#include "ice/user.h"\n#include "fram/ice.h"\n#include <math.h>\n')
        self.plant("src/ice/user.h", "#define USER 1\n")
        self.plant("include/fram/ice.h", "#define FRAM_ICE 1\n")
        self.assertEqual([line for line in self.unused() if "included" in line], [])

    def test_a_good_house_is_silent(self):
        self.plant("src/base/vec.h", "#include <math.h>\nstatic inline double f(double x) { return sqrt(x); }\n")
        self.plant("src/ice/floe.c", '#include "ice/floe.h"\n#include "base/vec.h"\n#include "fram/error.h"\n')
        self.plant("src/cli/main.c", '#include "cli/options.h"\n#include "fram/fram.h"\n')
        self.plant("src/base/words.c",
                   '/* sin(x) in words */ const char *t = "cos(x)"; double a = w.sin(1) + c->log(1);\n')
        self.plant("tests/testing.h", "")
        self.plant("tests/ice/test_floe.c", '#include "ice/floe.h"\n#include "testing.h"\n')
        self.assertEqual(self.rooms(), "")

    def test_circles_of_files_are_cut_or_named(self):
        self.plant("src/ice/floe.h", '/* Floes. */\n#include "ice/crack.h"\n')
        self.plant("src/ice/crack.c", '#include "ice/crack.h"\n#include "ice/floe.h"\n')
        self.plant("src/ice/crack.h", "/* Cracks. */\n")
        self.assertIn("a circle of files: crack, floe", self.rooms())
        self.plant("src/ice/crack.h", "/* Cracks; one module with\n   floe: pieces are floes. */\n")
        self.assertEqual(self.rooms(), "")

    def test_long_files_of_the_source(self):
        self.plant("src/ice/floe.c", "int x;\n" * 501)
        self.plant("src/ice/floe_kernel.c", "int x;\n" * 501)
        self.plant("tests/ice/test_floe.c", "int x;\n" * 501)
        said = self.rooms()
        self.assertIn("src/ice/floe.c:501: 501 lines; at most 500", said)
        self.assertEqual(said.count("lines; at most"), 1)

    def test_files_at_the_top(self):
        self.plant("README.md", "Read me.\n")
        self.plant("scenes/demo.yaml", "run: {}\n")
        self.assertEqual(self.rooms(), "")
        self.plant("demo.yaml", "run: {}\n")
        self.assertIn("demo.yaml:1: at the top of the tree stands none but .clang-format", self.rooms())

    def test_files_that_the_architecture_names(self):
        self.plant("src/ice/floe.c", "int x;\n")
        self.plant("docs/architecture.md", "See `ice/floe.c` and\n`ice/crack.c`, `fuzz/corpus`.\n")
        self.assertEqual(self.rooms(), "docs/architecture.md:2: there is no ice/crack.c\n")

    def test_upward_and_sideways_includes(self):
        self.plant("src/base/vec.h", '\n#include "ice/floe.h"\n')
        self.plant("src/ice/floe.c", '#include "vessel/hull.h"\n')
        self.plant("tests/fluid/test_drag.c", '#include "sim/world.h"\n')
        said = self.rooms()
        self.assertIn("src/base/vec.h:2: ", said)
        self.assertIn("src/ice/floe.c:1: ", said)
        self.assertIn("tests/fluid/test_drag.c:1: ", said)

    def test_what_a_room_must_not_know_though_it_stands_above(self):
        for room, header in (("results", "model/world.h"), ("study", "model/world.h"), ("study", "sim/step.h")):
            with self.subTest(room=room, header=header):
                self.plant(f"src/{room}/table.c", f'#include "base/vec.h"\n#include "{header}"\n')
                self.assertEqual(self.rooms(), f'src/{room}/table.c:2: "{header}": {room} must not know it\n')
                self.plant(f"src/{room}/table.c", '#include "model/scenario.h"\n')
        self.plant("tests/results/test_table.c", '#include "model/world.h"\n')
        self.plant("src/sim/run.c", '#include "model/world.h"\n#include "sim/sanity.h"\n')
        self.assertEqual(self.rooms(), "")
        self.plant("src/sim/build_ice.c", '#include "sim/sanity_parts.h"\n')
        self.assertIn("src/sim/build_ice.c:1: ", self.rooms())

    def test_the_command_sees_only_the_public_headers(self):
        self.plant("src/cli/main.c", '#include "sim/world.h"\n')
        self.plant("src/sim/run.c", '#include "fram/fram.h"\n')
        said = self.rooms()
        self.assertIn("src/cli/main.c:1: ", said)
        self.assertIn("src/sim/run.c:1: ", said)

    def test_include_forms_and_libraries(self):
        self.plant("src/ice/a.c", '#include "floe.h"\n')
        self.plant("src/ice/b.c", "#include <geos_c.h>\n")
        said = self.rooms()
        self.assertIn("src/ice/a.c:1: ", said)
        self.assertIn("src/ice/b.c:1: ", said)

    def test_headers_of_tests_and_of_further_libraries(self):
        self.plant("tests/testing.h", "int x;\n")
        self.plant("tests/ice/test_a.c", '#include "testing.h"\n')
        self.assertEqual(self.rooms(), "")
        self.plant("src/ice/a.c", '#include "testing.h"\n')
        self.plant("src/ice/b.c", "#include <netcdf.h>\n#include <netcdf_mem.h>\n#include <microhttpd.h>\n")
        said = self.rooms()
        self.assertIn('src/ice/a.c:1: "testing.h" is not of the form', said)
        for line in (1, 2, 3):
            self.assertIn(f"src/ice/b.c:{line}: ", said)

    def test_long_files_and_lines_reminders_and_machine_paths(self):
        self.plant("src/ice/long.c", "int a;\n" * 801)
        self.plant("src/ice/later.c", "/* " + "TO" + "DO */\n")
        self.plant("src/ice/wide.c", "/* " + "a" * 120 + " */\n")
        self.plant("docs/guide.md", "see /ho" + "me/someone/file\n")
        said = self.rooms()
        self.assertIn("src/ice/long.c:801: ", said)
        self.assertIn("src/ice/later.c:1: ", said)
        self.assertIn("src/ice/wide.c:1: ", said)
        self.assertIn("docs/guide.md:1: ", said)

    def documents(self):
        done = subprocess.run([sys.executable, self.root / "tools/check_documents.py"], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        # The tools themselves cite pages that this small house lacks.
        return "".join(line for line in done.stdout.splitlines(True) if not line.startswith("tools/"))

    def test_documents_cite_what_is_there(self):
        self.plant("src/ice/floe.c", "int a; /* docs/theory.md */\n")
        self.plant("docs/theory.md",
                   "# Ice & water\n\n```\n# no heading\n```\n## Ice & water\n[a\nlink](#ice--water-1)\n")
        self.plant("README.md",
                   "[t](docs/theory.md#ice--water), `src/ice/*.c`, src/ice/floe, build/x.md, src/<room>/a.c\n")
        self.assertEqual(self.documents(), "")

    def test_documents_that_cite_what_is_not_there(self):
        self.plant("src/ice/floe.c", "\n/* docs/absent.md */\n")
        self.plant("viewer/src/scene.js", "// src/ice/floe.c, src/ice/gone.h, src/library/any.c\n")
        self.plant("docs/theory.md", "# Ice\n\n[a\nlink](absent.md)\n")
        self.plant("README.md", "[t](docs/theory.md#water)\n[t](../README.md)\n`src/ice/wave.h`\n`src/*.none`\n")
        said = self.documents()
        for line in ("src/ice/floe.c:2: docs/absent.md is", "docs/theory.md:3: the link absent.md",
                     "README.md:1: the link", "README.md:2: the link ../README.md", "README.md:3: src/ice/wave.h",
                     "README.md:4: src/*.none", "viewer/src/scene.js:1: src/ice/gone.h is"):
            self.assertIn(line, said)
        self.assertEqual(said.count("scene.js"), 1)

    def test_links_of_what_is_installed(self):
        self.plant("src/ice/floe.c", "int a;\n")
        self.plant("docs/theory.md", "# Ice\n")
        self.plant("bench/results/users.md", "# Users\n")
        self.plant("package/README.md", "[a](scenes/demo.yaml) [b](docs/theory.md#ice) [c](https://a.example/)\n")
        self.plant("package/docs/theory.md", "# Ice\n[a](../src/ice/floe.c)\n[b](../README.md)\n")
        self.plant("package/examples/scenes/demo.yaml", "run: {}\n")

        def said(*words):
            done = subprocess.run([sys.executable, self.root / "tools/check_documents.py", "--installed",
                                   self.root / "package", *words], capture_output=True, text=True)
            self.assertEqual((done.stderr, done.returncode), ("", 1 if done.stdout else 0))
            return done.stdout.replace(f" in {self.root.resolve()}/package", "")

        self.assertEqual(said(), "README.md: the link scenes/demo.yaml leads to nothing\n")
        (self.root / "package/scenes").symlink_to("examples/scenes")
        self.assertEqual(said(), "")
        self.plant("package/docs/theory.md", "# Water\n[a](../src/ice/gone.c)\n[b](../bench/results/users.md)\n")
        self.assertEqual(said(), "README.md: the link docs/theory.md#ice leads to no heading of its page\n"
                         "docs/theory.md: the link ../src/ice/gone.c leads to nothing\n"
                         "docs/theory.md: the link ../bench/results/users.md leads to nothing\n")
        self.assertEqual(said("--without", "bench/").count("\n"), 2)

    def test_decisions_that_were_replaced_say_so(self):
        old = "docs/decisions/0001-old.md"
        self.plant("docs/decisions/0002-new.md", "# New\n\n**Replaces** [0001](0001-old.md) in\nwhat it does.\n")
        self.plant(old, "# Old\n\n**Since then** all is new\n([0002](0002-new.md)).\n\n**Context.**\n")
        self.assertEqual(self.documents(), "")
        self.plant(old, "# Old\n\n**Context.** Once.\n\nSee [0002](0002-new.md).\n")
        self.assertEqual(self.documents(), "docs/decisions/0002-new.md:3: 0001-old.md is replaced by this page, and "
                         "its first paragraph does not name it\n")

    def test_documents_that_name_commands_and_tests(self):
        self.plant("src/cli/main.c", 'static const command_row commands[] = {\n    {"run", "SCENARIO",\n')
        self.plant("tests/ice/test_floe.c", "START_TEST(a_floe_floats)\n")
        self.plant("docs/theory.md", "`fram run --help`, `ice/floe` a_floe_floats, `ice/absent.h` and `peers/ice`\n")
        self.assertEqual(self.documents(), "")
        self.plant("docs/theory.md", "`fram sail`\n`ice/wave`\n`ice/floe` a_floe_floats, a_floe_sinks\n")
        self.assertEqual(self.documents(), "docs/theory.md:1: `fram sail` is no command\n"
                         "docs/theory.md:2: there is no test ice/wave\n"
                         "docs/theory.md:3: the test ice/floe has no case a_floe_sinks\n")

    def test_keys_that_nothing_sets(self):
        def said():
            done = subprocess.run([sys.executable, self.root / "tools/check_keys.py"], capture_output=True, text=True)
            self.assertEqual((done.stderr, done.returncode), ("", 1 if done.stdout else 0))
            return done.stdout

        self.plant("docs/input-reference.md", "## ice\n\n| `grip` | number |\n| `salt` | number |\n| `age` | text |\n")
        self.plant("tests/sim/test_a.c", 'START_TEST(salt) "ice.grip=2" s.salt = 3; a->salt == 4\n')
        self.plant("scenes/a.yaml", "ice: {age: 4}\n")
        self.assertEqual(said(),
                         "docs/input-reference.md: no test and no scene sets ice.salt: add a test of its effect\n")
        self.plant("tests/cli/test_a.py", "{'salt': 3}\n")
        self.assertEqual(said(), "")

    def test_libm_in_the_source(self):
        self.plant("src/ice/wave.c", "double f(double x)\n{\n    return sin (x) + powf(2, 3);\n}\n")
        said = self.rooms()
        self.assertIn("src/ice/wave.c:3: sin()", said)
        self.assertIn("powf()", said)

    def together(self, *texts):
        """A build that compiles files of one room in two batches, as CMake makes it, and what is said of it."""
        build = self.root / "build/release"
        batches = build / "CMakeFiles/base_objects.dir/Unity"
        entries = []
        for i, text in enumerate(texts):
            self.plant(f"src/base/file{i}.c", text)
            self.plant(batches / f"unity_{i}_c.c", f'/* made */\n#include "{self.root}/src/base/file{i}.c"\n')
            entries.append({"directory": str(build), "file": str(batches / f"unity_{i}_c.c"),
                            "command": f"cc -Wall -Wshadow -Wno-shadow -O2 -o some.o -c {batches}/unity_{i}_c.c"})
        self.plant(build / "compile_commands.json", json.dumps(entries))
        return subprocess.run([sys.executable, self.root / "tools/check_together.py", build],
                              capture_output=True, text=True)

    def test_names_of_files_that_are_compiled_together(self):
        one, other = "static int next(int i) { return i + 1; }\n", "int use{0}(int i) {{ return next(i); }}\n"
        done = self.together(one + other.format(0), one + other.format(1))
        self.assertEqual(done.returncode, 1)
        self.assertIn("redefinition of", done.stderr)
        done = self.together(one + other.format(0), "int next;\n")
        self.assertEqual(done.returncode, 1)
        done = self.together(one + other.format(0), (one + other.format(1)).replace("next", "after"))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_names_that_hide_others_where_a_file_is_compiled_alone(self):
        kind = "typedef int kind;\n"
        done = self.together(kind + "int of(int x) { int own = x; return own; }\n",
                             "int other(int x) { int own = x; return own; }\nint own(void) { return 0; }\n")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        done = self.together(kind + "int of(int x) { int kind = x; return kind; }\n", "int last;\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("src/base/file0.c:2", done.stderr)
        self.assertIn("shadow", done.stderr)

    def test_files_that_are_compiled_together_are_analysed_alone(self):
        self.together("int first;\n", "int second;\n")
        sys.path.insert(0, str(TOOLS))
        import tidy
        found = tidy.commands(self.root / "build/release")
        self.assertEqual([entry["command"] for entry in found],
                         [f"cc -Wall -Wshadow -O2 -o some.o -c {self.root}/src/base/file{i}.c" for i in range(2)])

    def sources(self, *patterns):
        """What sources.sh says in vendor/fram of the house."""
        return subprocess.run(["tools/sources.sh", *patterns], cwd=self.root / "vendor/fram", env=NO_GIT,
                              capture_output=True, text=True)

    @unittest.skipUnless(shutil.which("git"), "git is not here")
    def test_sources_in_a_tree_of_others(self):
        own = ["README.md", "src/ice/floe.c", "tools/sources.sh"]
        for name in own[:2] + ["build/release/a.c", "src/ice/floe.o", "tools/__pycache__/a.pyc", "out/a.c"]:
            self.plant("vendor/fram/" + name, "text\n")
        (self.root / "vendor/fram/tools/sources.sh").write_bytes((TOOLS / "sources.sh").read_bytes())
        (self.root / "vendor/fram/tools/sources.sh").chmod(0o755)
        subprocess.run(["git", "init", "-q"], cwd=self.root, env=NO_GIT, check=True)
        for ignored in ("", "vendor/\n"):
            self.plant(".gitignore", ignored)
            self.assertEqual(self.sources().stdout.splitlines(), own)
            self.assertEqual(self.sources("*.c", "*.md").stdout.splitlines(), own[:2])
        done = self.sources("*.none")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("vendor/fram fits *.none", done.stderr)
        subprocess.run(["git", "init", "-q"], cwd=self.root / "vendor/fram", env=NO_GIT, check=True)
        self.plant("vendor/fram/.gitignore", "*.c\n*.o\n__pycache__/\nbuild/\nout/\n")
        self.assertEqual(self.sources().stdout.splitlines(), [".gitignore", "README.md", "tools/sources.sh"])

    def test_git_is_asked_of_this_tree_alone(self):
        for path in (self.root / "tools").rglob("*.*"):
            # What it makes a clone of is the tree that git knows.
            if path.suffix in (".sh", ".py") and path.name != "fresh_machine.sh":
                for line in path.read_text(encoding="utf-8").splitlines():
                    if re.search(r'\bgit (-\S+ )*(log|ls-files|rev-parse)\b|"git",', line):
                        self.assertIn("--git-dir=.git", line, path.name)

    def test_libm_in_the_objects(self):
        self.assertEqual(self.objects("#include <math.h>\ndouble f(double x) { return floor(x); }\n"), "")
        self.assertIn("calls libm's cos", self.objects("#include <math.h>\ndouble f(double x) { return cos(x); }\n"))

    def test_writable_globals(self):
        self.assertEqual(self.objects("static const char *const t[] = {\"a\"};\n"
                                      "const char *f(int i) { return t[i]; }\n", "-fPIC"), "")
        self.assertIn("count is a writable global", self.objects("int count;\nint next(void) { return count++; }\n"))
        self.assertIn("writable global", self.objects("int next(void) { static int n = 7; return n++; }\n"))

    def test_fused_multiply_add(self):
        machine = subprocess.run(["cc", "-dumpmachine"], capture_output=True, text=True, check=True).stdout
        if not machine.startswith("x86_64"):
            self.skipTest("flags of x86-64")
        text = "double f(double a, double b, double c) { return a * b + c; }\n"
        self.assertIn("fused", self.objects(text, "-mfma", "-ffp-contract=fast"))
        self.assertEqual(self.objects(text, "-mfma", "-ffp-contract=off"), "")


class Commands(unittest.TestCase):
    def test_programs_that_make_runs_are_built_by_it(self):
        ran = 0
        for rule in re.split(r"\n(?=[a-z-]+:)", (TOOLS.parent / "Makefile").read_text()):
            built = " ".join(re.findall(r"--target ((?:.*\\\n)*.*)", rule)).split()
            for program in re.findall(r"\btests/(test_\w+)", rule):
                self.assertIn(program, built, f"make {rule.split(':')[0]}")
                ran += 1
        self.assertGreater(ran, 4)

    def test_folders_may_have_spaces_in_their_names(self):
        for line in (TOOLS.parent / "Makefile").read_text().splitlines():
            self.assertNotIn("$(CURDIR)", re.sub(r'"[^"]*"', "", line))


if __name__ == "__main__":
    unittest.main()
