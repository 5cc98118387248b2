"""What a random scene may have on top: several vessels, ships that drive themselves, drifting level ice, and so on.

Changing one key of a plain scene seldom reaches these, since they ask for several keys that fit together.
"""

import math

# What counts as reached, by what the tree holds: told of the scenarios that ran to their end.
REACHED = {
    "several vessels": lambda tree, ship: "vessels" in tree,
    "drifting level ice": lambda tree, ship: tree["ice"]["source"] == "level" and
                                             tree["domain"]["boundary"] == "feeding",
    "propulsion": lambda tree, ship: "bollard_pull" in ship.get("propulsion", {}),
    "a pattern": lambda tree, ship: ship.get("propulsion", {}).get("pattern", {}).get("kind", "none") != "none",
    "wash": lambda tree, ship: ship.get("wash", {}).get("active") is True,
    "a path": lambda tree, ship: bool(ship.get("path")),
    "sleep": lambda tree, ship: tree["ice"].get("sleep_speed", 0) > 0,
    "scattered strength": lambda tree, ship: any(tree["ice"].get("strength", {}).get(name, 0) > 0 for name in
                                                 ("flexural_variation", "crushing_variation")),
    "edges with inertia": lambda tree, ship: tree["ice"].get("fracture", {}).get("edge_inertia") is True,
    "flooding": lambda tree, ship: tree.get("environment", {}).get("floe_ventilation") is True,
}


def reached(tree):
    """Names of what the scenario has."""
    ships = tree.get("vessels") or [tree.get("vessel", {})]
    if "ice" not in tree or "source" not in tree["ice"] or "boundary" not in tree.get("domain", {}):
        return []
    return [name for name, holds in REACHED.items() if any(holds(tree, ship) for ship in ships)]


def drive(draw, ratio, time, ship):
    """A free ship gets propulsion, with a pattern, way points or neither, and at times its wash."""
    ship["propulsion"] = {"bollard_pull": 3e5 * ratio**3, "speed": round(draw.uniform(0.5, 3) * time, 6)}
    way = draw.random()
    if way < 0.4:
        ship["propulsion"]["pattern"] = {
            "kind": draw.choice(("line", "across", "circle", "square", "sector")),
            "distance": round(draw.uniform(20, 200) * ratio, 6), "width": round(draw.uniform(10, 200) * ratio, 6)}
    elif way < 0.8:
        ship["propulsion"]["waypoints"] = [{"x": round(draw.uniform(-200, 200) * ratio, 6),
                                            "y": round(draw.uniform(-200, 200) * ratio, 6)}
                                           for _ in range(draw.randint(1, 4))]
    if draw.random() < 0.5:
        ship["wash"] = {"active": True}


def along_a_path(draw, ratio, end, ship):
    """A towed or prescribed ship follows a path instead of a straight course."""
    x, y = ship.pop("x", 0.0), ship.pop("y", 0.0)
    ship.pop("speed", None)
    ship["path"] = [{"time": 0.0, "x": x, "y": y, "heading_deg": 0.0}]
    for i in range(draw.randint(1, 3)):
        x, y = x + draw.uniform(0, 2) * ratio, y + draw.uniform(-1, 1) * ratio
        ship["path"].append({"time": round((i + 1) * end / 3, 9), "x": round(x, 6), "y": round(y, 6),
                             "heading_deg": round(draw.uniform(-5, 5), 3)})


def another(draw, ratio, time, number):
    """A smaller vessel, beside the first one, that leaves it room."""
    y = (-1) ** number * 22 * ratio
    ship = {"name": f"other-{number}", "mode": draw.choice(("prescribed", "towed", "free", "free")),
            "x": round(draw.uniform(-40, -15) + 25 * (number // 3), 6) * ratio, "y": y,
            "speed": round(draw.uniform(0, 2) * time, 6),
            "hull": {"form": draw.choice(("box", "icebreaker", "ship")), "length": 22 * ratio, "beam": 7 * ratio,
                     "draught": 2 * ratio, "freeboard": 2 * ratio}}
    if ship["mode"] == "free":
        if draw.random() < 0.6:
            drive(draw, ratio, time, ship)
        else:
            ship["thrusters"] = [{"x": -8 * ratio, "kind": "main", "thrust": 5e4 * ratio**3, "setting": 0.5}]
    if draw.random() < 0.3:
        ship["fender_stiffness"] = 4e6 * ratio**2
    if draw.random() < 0.4:
        ship["approach"] = {"limit": 10 * ratio, "look_ahead": 60 * time}
    return ship


def list_vessels(draw, ratio, time, tree):
    """The one vessel becomes the first of two to four."""
    first = {"name": "first", **tree.pop("vessel")}
    tree["vessels"] = [first] + [another(draw, ratio, time, n + 1) for n in range(draw.randint(1, 3))]


def let_drift(draw, ratio, time, tree):
    """Level ice that drifts, from afar or from an edge, with openings where the vessels are."""
    tree["domain"]["boundary"] = "feeding"
    tree["ice"]["level"] = {} if draw.random() < 0.7 else {"x_min": 30 * ratio}
    tree["ice"]["level"]["openings"] = [
        {"x": 0, "y": 0, "length": 60 * ratio, "width": round(draw.choice((18, 18, 58)) * ratio, 6)}]
    for ship in tree.get("vessels", [])[1:]:
        tree["ice"]["level"]["openings"].append({"x": ship.get("x", -20 * ratio), "y": ship.get("y", 0),
                                                 "length": 34 * ratio, "width": 12 * ratio})
    if draw.random() < 0.3:
        tree["ice"]["level"]["line_load"] = round(10 ** draw.uniform(3, 6) * ratio, 6)
    way = draw.random()
    if way < 0.4:
        tree["domain"].update(drift_speed=round(draw.uniform(0.1, 3) * time, 6),
                              drift_direction_deg=round(draw.uniform(0, 360), 2))
    elif way < 0.8:
        tree["environment"].update(current_speed=round(draw.uniform(0.2, 3) * time, 6), current_direction_deg=180)


def add(draw, tree, ratio):
    """What the scene gets on top."""
    time = math.sqrt(ratio)
    ship, ice = tree["vessel"], tree["ice"]
    if ship["mode"] == "free" and "thrusters" not in ship and draw.random() < 0.5:
        drive(draw, ratio, time, ship)
    several = ship["hull"]["form"] != "cone" and draw.random() < 0.25
    if several:
        list_vessels(draw, ratio, time, tree)
    if ice["source"] == "level" and draw.random() < 0.6:
        let_drift(draw, ratio, time, tree)
    if ship["mode"] != "free" and draw.random() < 0.15:
        along_a_path(draw, ratio, tree["run"]["duration"], tree["vessels"][0] if several else ship)
    # What a field drifts through does not rest, nor a sheet that is slowed down.
    fed = tree["domain"]["boundary"] == "feeding"
    if draw.random() < 0.2 and (not fed or ice["source"] == "level" and "line_load" not in ice["level"]):
        ice.update(sleep_speed=round(draw.choice((0.02, 0.2, 1)) * time, 6),
                   sleep_time=round(draw.choice((0.05, 0.3, 1)) * time, 6))
    if draw.random() < 0.2:
        ice["strength"] = {"flexural_variation": round(draw.uniform(0, 0.8), 3),
                           "crushing_variation": round(draw.uniform(0, 0.8), 3),
                           "correlation_length": round(draw.uniform(2, 40) * ratio, 6)}
    if draw.random() < 0.3:
        ice["fracture"] = {"edge_inertia": draw.random() < 0.7, "brash": draw.random() < 0.5,
                           "wide_contacts": draw.random() < 0.3, "joint_loads": draw.random() < 0.7,
                           "edge_gaps": draw.random() < 0.7, "edge_melts": draw.random() < 0.7,
                           "splitting": draw.choice(("length", "toughness", "none"))}
    if draw.random() < 0.2:
        tree["environment"]["floe_ventilation"] = True
