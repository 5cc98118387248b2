"""Scenarios that several tests of the package begin with: a towed box beside one fixed floe, and a free vessel with two
thrusters in loose floes."""

TOWED = """
run: {duration: 0.4, time_step: 0.02}
vessel: {mode: towed, x: -26, speed: 3, ramp: 0.1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: floes, thickness: 0.5, floes: [{length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}]}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}
output: {frame_interval: 0.1}
"""
FREE = """
run: {duration: 2, time_step: 0.05}
vessel: {mode: free, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}, thrusters: [{x: 18}, {x: -18}]}
ice: {concentration: 0.3, mean_floe_area: 64, thickness: 0.3}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
"""
