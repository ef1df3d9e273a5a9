"""Numbers that the kernels of the energy equation take, by name.

Of a time step, step[0, ...]: rate = weight of the new state in d/dt (1/s); 1/dx, 1/dy (1/m); B of both bodies; tolerance (K)
and iterations of a column; dt, dt with the step before (s); weights of these two states (adding up to 1).
Of a scene, scale[0, ...]: p_H (Pa), h and a (m) of the Hertz units; ln of the inlet viscosity; u_b - u_a (m/s); inlet
temperature (deg C); column of X = 0.
"""

RATE, INV_X, INV_Y, B_A, B_B, TOLERANCE, ITERATIONS, BACK, BACK_2, NEAR, FAR = range(11)
STEP_NUMBERS = 11
P_HERTZ, H_HERTZ, A_HERTZ, LN_ETA0, SLIP, INLET, CENTRE = range(7)
SCENE_NUMBERS = 7
