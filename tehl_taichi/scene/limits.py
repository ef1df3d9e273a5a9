"""Ranges in which laws were measured."""

P_MEASURED = 1.1e9  # Pa: conductivity and heat capacity (Larsson et al. 2000); the laws stay at their values there
GAMMA_MEASURED = 107.0  # deg C: heat capacity
