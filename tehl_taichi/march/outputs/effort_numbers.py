"""Residuals of the equations, and the work of solving them."""

from tehl_taichi.march.step_output import Scalar, thermal

NEWTON = "Newton's method on all equations (pressure/newton)"
LOAD_ERROR = Scalar(name="load_error", unit="1", says="relative load error", over="maximum", source=NEWTON,
                    of=lambda s: abs(s.report.load_error), by_hand=2e-7)
MASS_ERROR = Scalar(name="mass_error", unit="1", says="net mass defect over the Couette flux", over="maximum",
                    source="balance of the faces (pressure/balances)", of=lambda s: s.report.mass_error, by_hand=1e-8)
RESIDUAL = Scalar(name="residual", unit="1", says="rms residual of the discrete equations", over="maximum", source=NEWTON,
                  of=lambda s: s.report.residual, by_hand=3e-7)
STEPS = Scalar(name="newton", unit="1", says="Newton steps", over="sum", source=NEWTON, of=lambda s: s.report.newton, by_hand=3)
CYCLES = Scalar(name="cycles", unit="1", says="Krylov iterations", over="sum", source="linear solves (pressure/linear)",
                of=lambda s: s.report.cycles, by_hand=11)
REJECTED = Scalar(name="rejected", unit="1", says="rejected attempts", over="sum", source="parts of a step (march/passage)",
                  of=lambda s: s.rejected, by_hand=1)
STEP = Scalar(name="dt_s", unit="s", says="time step", over="point", source="time.courant (scene/route)", of=lambda s: s.dt,
              by_hand=2e-6)
WALL = Scalar(name="wall_s", unit="s", says="run time of the step", over="sum", source="the clock", of=lambda s: s.wall,
              by_hand=0.25)
CHANGE = Scalar(name="temperature_change_K", unit="K", over="maximum", exists=thermal, source="rounds (march/passage)",
                says="estimated temperature change by one more round of the step",
                of=lambda s: s.heat.report.change, by_hand=0.02)
CLAMPED = Scalar(name="clamped", unit="1", says="nodes with a limited temperature", over="sum",
                 exists=thermal, source="heat/temperatures", of=lambda s: s.heat.report.clamped, by_hand=1)
