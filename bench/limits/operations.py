"""Floating-point operations of one run, counted instruction by instruction.

callgrind counts how often each instruction of the program and of its libraries runs; objdump says
what each one is. An operation is a sum, a product, a quotient, a root, a least or a greatest of one
number: an instruction on four lanes is four of them, a fused multiply-add two. So the operations
inside exp, atan and their kind are counted too, apart from the program's own.

callgrind offers the program a processor with AVX2 and FMA, without AVX-512: copies of a loop for
more lanes do the same operations. It always rounds to nearest, so that a search which rounds
outwards takes very slightly another way; units are those of the counted run.
"""
import collections
import os
import re
import subprocess
import tempfile

ARITHMETIC = re.compile(r"^v?(add|sub|mul|div|sqrt|min|max|addsub|hadd|hsub)([sp][sd])$")
FUSED = re.compile(r"^vfn?m(?:add|sub|addsub|subadd)(?:132|213|231)([sp][sd])$")
OF_KIND = {"div": "divisions", "sqrt": "roots"}
ALLOCATORS = ("malloc", "calloc", "realloc", "aligned_alloc", "memalign", "posix_memalign")


def operations_of(mnemonic, operands):
    """(kind, operations) of one instruction; no operations: (None, 0)."""
    found = ARITHMETIC.match(mnemonic)
    fused = FUSED.match(mnemonic)
    if not found and not fused:
        return None, 0
    form = found[2] if found else fused[1]
    lanes = 1
    if form[0] == "p":
        width = 64 if "zmm" in operands else 32 if "ymm" in operands else 16
        lanes = width // (8 if form[1] == "d" else 4)
    if fused:
        return "sums and products", 2 * lanes
    return OF_KIND.get(found[1], "sums and products"), lanes


def disassembled(path):
    """address -> (kind, operations) of the instructions of a file that do any."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", path], capture_output=True,
                          text=True, check=True).stdout
    out = {}
    for line in text.split("\n"):
        found = re.match(r"\s*([0-9a-f]+):\s+(?:lock |rep |bnd )?(\S+)\s*(.*)", line)
        if found:
            kind, count = operations_of(found[2], found[3])
            if count:
                out[int(found[1], 16)] = (kind, count)
    return out


def read_callgrind(path):
    """Runs of each (object, address), calls of each function by name, totals of the events."""
    names = {}

    def name(text):
        found = re.match(r"\((\d+)\)(?: (.*))?$", text)
        if found[2] is not None:
            names[found[1]] = found[2]
        return names[found[1]]

    runs, calls = collections.Counter(), collections.Counter()
    objects, functions = {}, {}
    events, totals = [], []
    at, called, of_call = None, None, False
    for line in open(path, encoding="utf-8"):
        line = line.rstrip("\n")
        key, _, rest = line.partition("=")
        if key in ("ob", "cob"):
            found = re.match(r"\((\d+)\)(?: (.*))?$", rest)
            if found[2] is not None:
                objects[found[1]] = found[2]
            if key == "ob":
                at = objects[found[1]]
        elif key in ("fn", "cfn"):
            found = re.match(r"\((\d+)\)(?: (.*))?$", rest)
            if found[2] is not None:
                functions[found[1]] = found[2]
            called = functions[found[1]]
        elif key == "calls":
            calls[re.sub(r"'\d+$", "", called)] += int(rest.split()[0])
            of_call = True
        elif line.startswith("0x"):
            if not of_call:
                address, count = line.split()[:2]
                runs[at, int(address, 16)] += int(count)
            of_call = False
        elif line.startswith("events: "):
            events = line.split()[1:]
        elif line.startswith("summary: "):
            totals = [int(word) for word in line.split()[1:]]
    totals += [0] * (len(events) - len(totals))
    return runs, calls, dict(zip(events, totals))


def cache_bytes(name, otherwise):
    try:
        return int(subprocess.run(["getconf", name], capture_output=True, text=True).stdout)
    except ValueError:
        return otherwise


def count(study, load):
    """Operations, calls and traffic of one unit of a workload."""
    size = 1 << (cache_bytes("LEVEL3_CACHE_SIZE", 1 << 25).bit_length() - 1)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "callgrind")
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--dump-line=no", "--compress-pos=no",
             "--cache-sim=yes", f"--LL={size},16,64", "--toggle-collect=howl::limits::MeasuredRun*",
             f"--callgrind-out-file={out}", study, "--once", load],
            capture_output=True, text=True)
        if run.returncode != 0:
            raise SystemExit(f"{load}: {run.stderr}")
        runs, calls, totals = read_callgrind(out)
    units = float(run.stdout)
    result = collections.Counter(instructions=totals["Ir"] / units)
    listings = {}
    for (path, address), times in runs.items():
        if path not in listings:
            listings[path] = disassembled(path) if os.path.exists(path) else {}
        kind, number = listings[path].get(address, (None, 0))
        if number:
            where = "library" if re.search(r"/libm[.-]", path) else "own"
            result[where] += times * number / units
            result[kind] += times * number / units
    result["beyond L1"] = 64.0 * (totals["D1mr"] + totals["D1mw"]) / units
    result["memory"] = 64.0 * (totals["DLmr"] + totals["DLmw"]) / units
    functions = {}
    for function, times in calls.items():
        plain = function_called(function)
        if plain:
            functions[plain] = functions.get(plain, 0) + times / units
    return dict(result), functions


# Entries of the C library as the program calls them; what they call inside is a part of them.
ENTRIES = ["exp", "log", "pow", "sin", "cos", "sincos", "tan", "atan", "atan2", "hypot", "tanh",
           "fesetround"]


def function_called(name):
    """The entry that a function of the C library is, under any of its names; None for others."""
    if name in ALLOCATORS:
        return "malloc"
    found = re.match(r"^(?:__GI___|__)?([a-z]+[0-9]?)(?:@@?GLIBC\S*)?(?:_fma|_fma4|_sse2|_avx2)?$",
                     name)
    if not found or found[1] not in ENTRIES:
        return None
    return found[1]
