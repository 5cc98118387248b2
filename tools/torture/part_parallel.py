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


def case(rig, draw, folder):
    """Writers and readers together; in the end the folder can be brought to the one right end."""
    done = Case()
    work = fixture.copy(rig, folder / "work")
    (work / "half").rename(work / "shared")
    calls = [draw.choice(WRITERS) for _ in range(draw.randint(1, 3))] + \
        [draw.choice(READERS) for _ in range(draw.randint(1, 2))]
    draw.shuffle(calls)
    with concurrent.futures.ThreadPoolExecutor(len(calls)) as pool:
        outcomes = list(pool.map(lambda words: rig.fram.call(*words.split(), "--json", folder=work), calls))
    for outcome in outcomes:
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
