"""Structural isolability of the loop's blocks (faultdiagnosistoolbox): which blocks the equations and
the two sensors let be told apart at all, if every residual may be sensitive to whatever enters it."""
import faultdiagnosistoolbox as fdt

BLOCKS = ["acoustics", "source", "delay", "flame", "p_instrument", "q_instrument"]


def isolable():
    """{block: blocks that it cannot be isolated from}."""
    model = fdt.DiagnosisModel({
        "type": "VarStruc",
        "x": ["p", "dp", "z", "v", "w", "q"], "f": [f"f_{block}" for block in BLOCKS],
        "z": ["yp", "yq"],
        "rels": [
            ["p", "z", "q", "f_acoustics", "f_source"],  # p = G(s) q + what else drives the duct
            ["z", "p"],                                  # the integral of p, a state of G
            ["dp", "p"],                                 # dp/dt
            ["v", "dp", "f_delay"],                      # v(t) = dp(t - tau)
            ["w", "v", "f_flame"],                       # w = Phi(v)
            ["q", "w"],
            ["yp", "p", "f_p_instrument"],
            ["yq", "q", "f_q_instrument"]]}, name="loop")
    matrix = model.IsolabilityAnalysis(permute=False)  # 1: cannot be isolated
    order = [name.removeprefix("f_") for name in model.f]
    return {a: [b for j, b in enumerate(order) if j != i and matrix[i, j]]
            for i, a in enumerate(order)}
