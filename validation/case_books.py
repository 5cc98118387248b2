"""The books of a run: forces that sum, Newton's law for the towed hull, and ice that is neither lost nor made."""

import ladder
import world

LONG = False
END = 12.0
SCENES = {"managed_ice": {}, "level_ice": {}, "breaking floes": {"ice__breakable": "true", "ice__thickness": 0.5}}
PARTS = ("capped", "below_cap", "friction")
ZONES = ("bow", "shoulder", "midbody", "stern", "bottom")
AXES = ("x", "y", "z")


def path(scene):
    return ladder.ROOT / "scenes" / f"{'managed_ice' if scene == 'breaking floes' else scene}.yaml"


def ice_mass(scene, time, keys):
    """Mass of all floes at a time."""
    with world.World(path(scene), run__duration=END, run__transient=0, **keys) as w:
        w.run(time)
        return sum(s.mass for _, s in w.bodies("floe"))


def case(out):
    c = ladder.Case(
        "The books of a run",
        1,
        f"{END:g} s of the managed field, of level ice, and of the managed field with floes of 0.5 m that break: "
        "do the "
        "parts of the ice force sum to the force, and its zones; do carriage, ice and water together accelerate "
        "the hull; is "
        "the ice's mass that of the start less what is booked; do the areas of every event close.",
        "Sums, Newton's law and the conservation of area and mass.",
        "Sums, Newton's law and areas to 1e-9 of the largest value, mass to 1e-10; to Newton's law is added what the "
        "twelve digits of a speed in series.csv leave open (mass x 1e-11 m/s / dt). Ice lost and gained in an event is "
        "under 0.1 % of the floe, in a run under 0.5 % of what broke.",
    )
    c.header = ["quantity", *SCENES]
    rows = {}

    def enter(what, text):
        rows.setdefault(what, []).append(text)

    curve = None
    for scene, keys in SCENES.items():
        name = f"books/{scene.replace(' ', '_')}"
        all_keys = {"run__duration": END, "run__transient": 0, "output__frame_interval": 0, **keys}
        s = ladder.run(path(scene), name, **all_keys)
        force = ladder.greatest(abs(f) for axis in AXES for f in s[f"ice_force_{axis}"])
        enter("largest ice force [kN]", f"{force / 1e3:.0f}")

        def gap(total, parts):
            return ladder.greatest(abs(t - sum(p)) for t, *p in zip(s[total], *(s[part] for part in parts))) / force

        parts = ladder.greatest(gap(f"ice_force_{a}", [f"ice_force_{p}_{a}" for p in PARTS]) for a in AXES)
        zones = ladder.greatest(gap(f"ice_force_{a}", [f"ice_force_{z}_{a}" for z in ZONES]) for a in AXES)
        with world.World(path(scene), **all_keys) as w:
            mass = w.bodies("vessel")[0][1].mass
        step = s["time"][1] - s["time"][0]
        pull = ladder.greatest(abs(s[f"tow_force_{a}"][i] + s[f"ice_force_{a}"][i] + s[f"fluid_force_{a}"][i]
                                   - mass * (s[f"velocity_{a}"][i] - s[f"velocity_{a}"][i - 1]) / step)
                               for a in ("x", "y") for i in range(1, len(s["time"]))) / force
        # What the twelve digits of the files leave open: half a digit of each of two velocities.
        digits = mass * 2 * 0.5e-11 / step / force
        # At constant speed, after the ramp, the joint of the carriage holds the hull as well as the solver converges.
        slack = max(abs(a - b) for a, b in zip(s["velocity_x"], s["velocity_x"][1:]) if min(a, b) > 1.999) / 2
        enter("force less its three parts, over the largest", f"{parts:.1e}")
        enter("force less its five zones", f"{zones:.1e}")
        enter("tow, ice and water less mass times acceleration", f"{pull:.1e}")
        enter("largest change of the towing speed in a step, over it", f"{slack:.1e}")
        for what, value, most in (("parts", parts, 1e-9), ("zones", zones, 1e-9),
                                  ("Newton's law along and across the track", pull, 1e-9 + digits)):
            c.check(value <= most, f"{scene}: {what}: {value:.0e}, at most {most:.0e}")

        before, after = ice_mass(scene, 0, keys), ice_mass(scene, END, keys)
        booked = [s[f"ice_mass_{k}"][-1] for k in ("left", "lost", "crushed")] + [s["brash_mass"][-1]]
        brought = s["ice_mass_entered"][-1] + s["ice_mass_gained"][-1]
        off = abs(after - before + sum(booked) - brought) / before
        enter("mass of ice at the start [t]", f"{before / 1e3:.1f}")
        enter("mass at the end less start and books, over the start", f"{off:.1e}")
        c.check(off <= 1e-10, f"{scene}: mass of the ice, {off:.0e}, at most 1e-10")
        e = ladder.fractures(name)
        count = len(e["time"])
        enter("events", str(count))
        if not count:
            continue
        areas = ladder.greatest(abs(p - q - lost + gained) / p for p, q, lost, gained in
                                zip(e["floe_area"], e["pieces_area"], e["area_lost"], e["area_gained"]))
        worst = ladder.greatest((lost + gained) / p for p, lost, gained in
                                zip(e["floe_area"], e["area_lost"], e["area_gained"]))
        share = (sum(e["mass_lost"]) + sum(e["mass_gained"])) / before
        c.check(areas <= 1e-9, f"{scene}: areas of {count} events close to {areas:.0e}, at most 1e-9")
        c.check(worst <= 1e-3, f"{scene}: {100 * worst:.4f} % of a floe lost and gained in an event at most, 0.1 % "
                               f"allowed")
        c.check(share <= 5e-3, f"{scene}: {100 * share:.5f} % of all ice lost and gained in the run, 0.5 % allowed")
        enter("areas of an event, worst", f"{areas:.1e}")
        enter("lost and gained in an event, worst", f"{100 * worst:.4f} %")
        if scene == "level_ice":
            curve = s
    for what, texts in rows.items():
        c.rows.append([what, *([""] * (len(SCENES) - len(texts)) + texts)])

    def draw(axes):
        bottom = [0.0] * len(curve["time"])
        for part in PARTS:
            top = [b - f / 1e3 for b, f in zip(bottom, curve[f"ice_force_{part}_x"])]
            axes.fill_between(curve["time"], bottom, top, label={"capped": "normal, at the crushing limit",
                              "below_cap": "normal, below it", "friction": "friction"}[part], lw=0)
            bottom = top
        axes.plot(curve["time"], [-f / 1e3 for f in curve["ice_force_x"]], "k", lw=0.5, label="all")
        axes.set(xlabel="time [s]", ylabel="resistance [kN]")
        axes.legend(loc="upper left")

    ladder.figure(c, out, "books", "Level ice: the ice force along the track and its parts.", draw)
    return c
