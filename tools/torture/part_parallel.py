"""Several commands on one folder at once: one run a folder, readers that see whole files, writers that do not mix."""

import concurrent.futures

import books
import fixture
from finding import Case

NAME = "parallel"
SAYS = "two to five commands at once on one folder"
WRITERS = ("run scene.yaml -o shared --force", "resume shared", "run scene.yaml -o shared")
READERS = ("report shared", "view shared", "export shared --vtk", "export shared --netcdf", "plot shared",
           "plot shared ice_force_x -o p.png", "compare shared done", "export shared --geojson --time 0.2")


STUDY = "study study.yaml -o made --jobs 1"


def together(rig, work, calls):
    """All at once."""
    with concurrent.futures.ThreadPoolExecutor(len(calls)) as pool:
        return list(pool.map(lambda words: rig.fram.call(*words.split(), "--json", folder=work), calls))


def of_studies(rig, draw, folder):
    """Studies in one folder: they take their turns, or say who is in it; in the end it is what one alone makes."""
    done = Case()
    work = fixture.copy(rig, folder / "work")
    calls = [STUDY] * draw.randint(2, 4) + ["study list made"] * draw.randint(0, 1)
    for outcome in together(rig, work, calls):
        fault = outcome.fault(json_asked=True)
        gives_way = outcome.words[1] == "list" or "is writing into this folder" in outcome.err
        if not fault and outcome.code != 0 and not gives_way:
            fault = "fails oddly"
        done.counts["did its work" if outcome.code == 0 else "gave way"] += 1
        if fault:
            done.found(f"study {fault} beside others", outcome, told="together: " + "; ".join(calls))
    last = rig.fram.call(*STUDY.split(), "--json", folder=work)
    fault = last.fault(json_asked=True) or ("fails" if last.code else None)
    if not fault:
        held = fixture.contents(work)
        made, alone = ({name.split("/", 1)[1]: data for name, data in held.items() if name.startswith(folder + "/")}
                       for folder in ("made", "studied"))
        # It says where the scenario lies: that of the copy is elsewhere.
        names = sorted((set(made) | set(alone)) - {"effective.yaml"})
        others = [name for name in names if made.get(name) != alone.get(name)]
        fault = "another end: " + ", ".join(others[:5]) if others else None
    if fault:
        done.found("after studies side by side: " + fault, last, told="together: " + "; ".join(calls))
    return done


def case(rig, draw, folder):
    """Writers and readers together; in the end the folder can be brought to the one right end."""
    if draw.random() < 0.3:
        return of_studies(rig, draw, folder)
    done = Case()
    work = fixture.copy(rig, folder / "work")
    (work / "half").rename(work / "shared")
    calls = [draw.choice(WRITERS) for _ in range(draw.randint(1, 3))] + \
        [draw.choice(READERS) for _ in range(draw.randint(1, 2))]
    draw.shuffle(calls)
    for outcome in together(rig, work, calls):
        fault = outcome.fault(json_asked=True)
        done.counts[{0: "did its work", 1: "failed with a reason", 2: "gave way"}.get(outcome.code, "other")] += 1
        if fault:
            done.found(f"{outcome.words[0]} {fault} beside others", outcome, told="together: " + "; ".join(calls))
    last = rig.fram.call("run", "scene.yaml", "-o", "shared", "--force", "--json", folder=work)
    fault = last.fault(json_asked=True) or ("fails" if last.code else None) or books.look_at_run(work / "shared") or \
        books.differ(work / "done", work / "shared")
    if fault:
        done.found("after commands side by side: " + fault, last, told="together: " + "; ".join(calls))
    return done
