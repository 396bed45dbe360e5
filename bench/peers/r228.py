"""The problems that the comparisons share: test R228 of the paper, tables 2 and 3, as in
configs/r228.yaml and configs/r228_two_modes.yaml."""
import numpy as np

NAMES = [f"exp{k}" for k in range(1, 7)]
PHI = np.array([0.56, 0.53, 0.51, 0.49, 0.47, 0.45])
FREQUENCY_HZ = np.array([219.9, 209.1, 205.7, 202.7, 198.4, 179.8])
PHASE_DEG = np.array([-5.74, -9.44, -14.35, -19.18, -22.92, -42.72])
GAIN = np.array([12.14, 13.15, 14.79, 16.05, 18.80, 45.01])
FLAME_SLOPE = np.array([-0.703e-4, -0.707e-4, -0.670e-4, -0.626e-4, -0.401e-4, -0.0872e-4])
RELIABLE = np.array([True, True, True, True, False, False])
LINE_HZ, LINE_STD_HZ = 750.0, 10.0  # of the reliable experiments, with two modes

W = 2 * np.pi * FREQUENCY_HZ
PHASE = np.radians(PHASE_DEG)
# Equation (3): the shortest delay.
TAU_OF_PHASE_S = (1.5 * np.pi + PHASE) / W


def closed_form(xi, phase=PHASE, gain=GAIN, loop_phase=0.0):
    """One experiment's members for any xi: (5c) solved for omega and N, (1a) for tau."""
    omega_hz = FREQUENCY_HZ * np.exp(-np.arcsinh(xi * np.tan(-phase)))
    n = gain * 2 * xi * 2 * np.pi * omega_hz / np.cos(phase)
    return omega_hz, xi * np.ones(6), n, (1.5 * np.pi + phase - loop_phase) / W
