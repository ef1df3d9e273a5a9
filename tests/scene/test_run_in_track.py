"""Steel that a smooth contact would make flow all along its track: lines, points, soft layers."""

import pytest

import tehl_taichi as tehl
from tehl_taichi.scene import SceneError, run_in
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear")


@pytest.mark.parametrize("name, share", [("gear", 0.56), ("ball-on-disc", 0.62)])
def test_lines_flow_at_less_of_their_pressure_than_points(name, share):
    """Largest von Mises stress over p_H without friction (Johnson 1985)."""
    scene = tehl.scene(name)
    weak, strong = (scene.replace(**{"bodies.a.yield_stress": part * share * Scales.of(scene).p_H}) for part in (0.98, 1.02))
    run_in._check_track(strong, strong.surfaces[0])
    with pytest.raises(SceneError, match="whole track would flow"):
        run_in._check_track(weak, weak.surfaces[0])


@pytest.mark.parametrize("depth, flows", [(0.1, False), (0.7, True), (1.4, False)])
def test_the_steel_is_judged_at_the_depth_where_a_line_is_worst(tmp_path, depth, flows):
    """A soft layer 0.1 a thick, at 0.7 a or elsewhere."""
    a, path = Scales.of(GEAR).a, tmp_path / "soft.csv"
    rows = ((0.0, 3e9), (depth - 0.06, 3e9), (depth - 0.05, 2e8), (depth + 0.05, 2e8), (depth + 0.06, 3e9))
    path.write_text("depth_m,limit_Pa,yield_stress_Pa\n" + "".join(f"{at * a},4e8,{stress}\n" for at, stress in rows))
    scene = GEAR.replace(**{"fatigue.table": str(path)})
    if not flows:
        return run_in._check_track(scene, scene.surfaces[0])
    with pytest.raises(SceneError, match="whole track would flow"):
        run_in._check_track(scene, scene.surfaces[0])
