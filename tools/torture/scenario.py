"""Random scenarios, drawn from the schema: a small sound scene, and some of its keys set to something else."""

import math

import extras

# What a scene may cost; the keys that are not drawn but set, since they decide it.
MOST_STEPS = 150
MOST_FLOES = 300
# Keys that decide the cost of a step, with the largest value drawn.
DEAR = {
    "run.solver.iterations": 100, "run.solver.position_iterations": 50, "run.solver.most_iterations": 2000,
    "ice.fracture.wedges": 16, "vessel.hull.most_pieces": 64, "ice.populations[].vertices_max": 16,
    "ice.populations[].elongation": 4, "vessel.mooring.lines[].count": 16,
}
# What keeps a scene short and small: not left out when a finding is made smaller.
KEEPS_IT_SMALL = (("run", "duration"), ("run", "time_step"), ("domain", "x_min"), ("domain", "x_max"),
                  ("domain", "y_min"), ("domain", "y_max"), ("ice", "mean_floe_area"), ("ice", "populations"))
# Lengths of the scene, set together; files, which the inputs' part draws.
GIVEN = {"run.duration", "domain.x_min", "domain.x_max", "domain.y_min", "domain.y_max", "ice.mean_floe_area",
         "output.frame_interval", "output.picture_interval", "output.checkpoint_interval", "output.csv_interval"}


def scene(draw):
    """The sound scene to begin with: a ship of 48 m (at scale 30) in a kind of ice, held in one of three ways."""
    scale = draw.choice((1, 30, 30, 30, 100))
    ratio = scale / 30
    time = math.sqrt(ratio)
    step = draw.choice((0.005, 0.01, 0.02, 0.05)) * time
    steps = draw.randint(3, MOST_STEPS)
    mode = draw.choice(("prescribed", "towed", "free"))
    source = draw.choice(("voronoi", "voronoi", "floes", "none", "level", "packed"))
    boundary = draw.choice(("walls", "open", "feeding")) if source in ("voronoi", "packed") else \
        draw.choice(("walls", "open"))
    tree = {
        "run": {"duration": round(steps * step, 9), "time_step": round(step, 9), "seed": draw.randint(0, 1 << 30),
                "scale": scale},
        "vessel": {"mode": mode, "speed": round(draw.uniform(0, 4) * time, 6), "hull": {
            "form": draw.choice(("box", "icebreaker", "icebreaker", "cone")), "length": 48 * ratio,
            "beam": 12 * ratio, "draught": 4 * ratio, "freeboard": 2 * ratio}},
        "ice": {"source": source, "mean_floe_area": round(8192 * ratio**2 / draw.randint(10, MOST_FLOES), 9),
                "concentration": round(draw.uniform(0.3, 0.85), 3),
                "thickness": round(draw.uniform(0.1, 1.5) * ratio, 6),
                "breakable": draw.random() < 0.6},
        "domain": {"x_min": -64 * ratio, "x_max": 64 * ratio, "y_min": -32 * ratio, "y_max": 32 * ratio,
                   "boundary": boundary},
        "environment": {"current_speed": round(draw.uniform(0, 1.5) * time, 6),
                        "current_direction_deg": round(draw.uniform(0, 360), 2)},
        "output": {"frame_interval": round(10 * step, 9), "checkpoint_interval": round(max(1, steps // 3) * step, 9)},
    }
    if tree["vessel"]["hull"]["form"] == "cone":
        tree["vessel"]["hull"].update(length=30 * ratio, beam=30 * ratio, flare_angle_deg=45)
    if source == "level":
        tree["ice"]["level"] = {"x_min": 30 * ratio}
    if source == "floes":
        tree["ice"]["floes"] = [{"x": round((30 + 14 * (i % 3)) * ratio, 6), "y": round(14 * (i // 3 - 1) * ratio, 6),
                                 "length": 12 * ratio, "width": 12 * ratio, "velocity_x": -time}
                                for i in range(draw.randint(1, 9))]
    if source == "packed":
        size = math.sqrt(tree["ice"]["mean_floe_area"])
        tree["ice"]["populations"] = [{"diameter_min": round(0.7 * size, 9), "diameter_max": round(2 * size, 9)}]
    if mode == "free" and draw.random() < 0.7:
        tree["vessel"]["mooring"] = {"depth": 60 * ratio, "lines": [
            {"count": draw.choice((3, 4, 8)), "spacing_deg": draw.choice((30, 45, 90)), "distance": 300 * ratio,
             "weight": 300 * ratio**2, "stiffness": 3e8 * ratio**3, "pretension": 2e5 * ratio**3}]}
    if mode == "free" and draw.random() < 0.7:
        tree["vessel"]["thrusters"] = [{"x": 18 * ratio, "thrust": 1e5 * ratio**3},
                                       {"x": -18 * ratio, "kind": "main", "thrust": 1e5 * ratio**3}]
        tree["vessel"]["positioning"] = {"active": True}
    extras.add(draw, tree, ratio)
    return tree


def number(draw, key, now):
    """A number for a key: mostly near what it was, at times anywhere in its range, or at an end of it."""
    top = min(key.high, DEAR.get(".".join((*key.path, key.name)), key.high))
    kind = draw.random()
    if kind < 0.75:
        base = now if isinstance(now, (int, float)) and now else draw.choice((0.01, 0.1, 1, 10))
        value = base * 10 ** draw.uniform(-0.5, 0.5)
        if key.low < 0 and draw.random() < 0.3:
            value = -value
    elif kind < 0.9:
        smallest = max(key.low, top * 1e-12, 1e-9)
        value = math.exp(draw.uniform(math.log(smallest), math.log(max(top, smallest))))
        if key.low < 0 and draw.random() < 0.5:
            value = max(-value, key.low)
    else:
        value = draw.choice((key.low, top, 0))
    value = min(max(value, key.low), top)
    return int(value) if key.kind == "integer" else float(f"{value:.6g}")


def value_for(draw, key, now):
    """A value that the schema allows, other than a file."""
    if key.kind == "boolean":
        return draw.random() < 0.5
    if key.kind == "choice":
        return draw.choice(key.choices)
    if key.kind == "text":
        return draw.choice(("", "a: b", "\u2603 snow", "x" * 300, "'\"\\"))
    if key.automatic and draw.random() < 0.2:
        return "auto"
    return number(draw, key, now)


def place(tree, path, make, draw):
    """The mapping at a section's path, made where it is wanted; None where there is none."""
    node = tree
    for name in path:
        plain = name.removesuffix("[]")
        if node is tree and plain == "vessel" and "vessels" in tree:
            plain = "vessels"
        if plain not in node:
            if not make:
                return None
            node[plain] = [{}] if name.endswith("[]") else {}
        node = node[plain]
        if isinstance(node, list):
            if not node:
                return None
            node = draw.choice(node)
        if not isinstance(node, dict):
            return None
    return node


def perturb(draw, sections, tree, count):
    """Set count keys, mostly in sections that the scene has."""
    done = 0
    for _ in range(20 * count):
        if done >= count:
            return
        section = draw.choice(sections)
        node = place(tree, section.path, draw.random() < 0.15, draw)
        if node is None or not section.keys:
            continue
        key = draw.choice(section.keys)
        if key.kind == "path" or ".".join((*key.path, key.name)) in GIVEN:
            continue
        now = node.get(key.name, key.default)
        if isinstance(now, float) and key.power:
            now *= (tree["run"]["scale"] / 30) ** key.power
        node[key.name] = value_for(draw, key, now)
        if key.name == "time_step":
            tree["run"]["duration"] = draw.randint(3, MOST_STEPS) * node[key.name]
        done += 1


def random_scenario(draw, sections):
    """A scenario as a tree of mappings and lists."""
    tree = scene(draw)
    perturb(draw, sections, tree, draw.choice((0, 1, 1, 2, 3, 5, 8, 13)))
    return tree


def text_of(tree, indent=0):
    """The tree as YAML in block style."""
    lines = []
    pad = " " * indent
    for name, value in tree.items():
        if isinstance(value, dict):
            lines.append(f"{pad}{name}:" if value else f"{pad}{name}: {{}}")
            lines.append(text_of(value, indent + 2) if value else "")
        elif isinstance(value, list):
            lines.append(f"{pad}{name}:" if value else f"{pad}{name}: []")
            for item in value:
                inner = text_of(item, indent + 4)
                lines.append(f"{pad}  - {inner.lstrip()}" if item else f"{pad}  - {{}}")
        else:
            lines.append(f"{pad}{name}: {scalar(value)}")
    return "\n".join(line for line in lines if line)


def scalar(value):
    """A value as YAML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str) and value != "auto" and not value.isidentifier():
        return "'" + value.replace("'", "''") + "'"
    return repr(value) if isinstance(value, float) else str(value)


def leaves(tree, path=()):
    """Paths to everything that could be left out, inner things last."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for name, value in items:
        yield (*path, name)
        if isinstance(value, (dict, list)):
            yield from leaves(value, (*path, name))


def without(tree, path):
    """A copy without what stands at the path."""
    if isinstance(tree, dict):
        return {k: (without(v, path[1:]) if k == path[0] and len(path) > 1 else v)
                for k, v in tree.items() if k != path[0] or len(path) > 1}
    return [without(v, path[1:]) if i == path[0] and len(path) > 1 else v
            for i, v in enumerate(tree) if i != path[0] or len(path) > 1]


def shrink(tree, still_fails, tries=80):
    """A smaller tree that fails alike: leave out whole sections first, then keys, while it still fails."""
    changed = True
    while changed and tries > 0:
        changed = False
        for path in list(leaves(tree)):
            if tries <= 0:
                break
            if any(kept[:len(path)] == path for kept in KEEPS_IT_SMALL):
                continue
            try:
                smaller = without(tree, path)
            except (KeyError, IndexError, TypeError):
                continue
            if smaller == tree:
                continue
            tries -= 1
            if still_fails(smaller):
                tree, changed = smaller, True
    return tree
