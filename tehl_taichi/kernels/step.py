"""Numbers of a time step, step[0, ...] of the kernels that take one.

rate = weight of the new state in d/dt (1/s); 1/dx, 1/dy (1/m); B of both bodies; tolerance (K) and iterations of a column; dt,
dt with the step before (s); weights of these two states (adding up to 1).
"""

RATE, INV_X, INV_Y, B_A, B_B, TOLERANCE, ITERATIONS, BACK, BACK_2, NEAR, FAR = range(11)
STEP_NUMBERS = 11
