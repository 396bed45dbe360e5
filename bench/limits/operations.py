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
OF_KIND = {"div": "division", "sqrt": "root"}
LIBRARY = re.compile(r"/libm[.-]")
ALLOCATORS = ("malloc", "calloc", "realloc", "aligned_alloc", "memalign", "posix_memalign")


def operations_of(mnemonic, operands):
    """(kind, lanes, operations) of one instruction, None where it does none."""
    found = ARITHMETIC.match(mnemonic)
    fused = FUSED.match(mnemonic)
    if not found and not fused:
        return None
    form = found[2] if found else fused[1]
    lanes = 1
    if form[0] == "p":
        width = 64 if "zmm" in operands else 32 if "ymm" in operands else 16
        lanes = width // (8 if form[1] == "d" else 4)
    if fused:
        return "sum or product", lanes, 2 * lanes
    return OF_KIND.get(found[1], "sum or product"), lanes, lanes


def disassembled(path):
    """address -> operations_of() the instruction there, of those of a file that do any."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", path], capture_output=True,
                          text=True, check=True).stdout
    out = {}
    for line in text.split("\n"):
        found = re.match(r"\s*([0-9a-f]+):\s+(?:lock |rep |bnd )?(\S+)\s*(.*)", line)
        if found:
            does = operations_of(found[2], found[3])
            if does:
                out[int(found[1], 16)] = does
    return out


def read_callgrind(path):
    """Runs of each (object, address), calls of each function by its name, totals of the events.

    Counts of calls in the file are of the whole program, before the measured run too; so a call is
    counted where the first instruction of a function runs."""
    runs, entries = collections.Counter(), {}
    objects, functions = {}, {}
    events, totals = [], []
    at, inside, of_call = None, None, False
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            key, _, rest = line.rstrip("\n").partition("=")
            named = re.match(r"\((\d+)\)(?: (.*))?$", rest)
            if named and key in ("ob", "cob", "fn", "cfn"):
                names = objects if key.endswith("ob") else functions
                if named[2] is not None:
                    names[named[1]] = named[2]
                if key == "ob":
                    at = names[named[1]]
                elif key == "fn":
                    inside = re.sub(r"'\d+$", "", names[named[1]])
            elif key == "calls":
                of_call = True
            elif line.startswith("0x"):
                if not of_call:  # else the cost of the function called
                    words = line.split()
                    address = int(words[0], 16)
                    runs[at, address] += int(words[1])
                    if (at, inside) not in entries or address < entries[at, inside]:
                        entries[at, inside] = address
                of_call = False
            elif line.startswith("events: "):
                events = line.split()[1:]
            elif line.startswith("summary: "):
                totals = [int(word) for word in line.split()[1:]]
    totals += [0] * (len(events) - len(totals))
    calls = collections.Counter()
    for (where, function), address in entries.items():
        calls[function] += runs[where, address]
    return runs, calls, dict(zip(events, totals))


def last_cache_bytes():
    """Of the last cache, down to a power of two; 32 MiB where the machine does not say."""
    try:
        with open("/sys/devices/system/cpu/cpu0/cache/index3/size", encoding="ascii") as said:
            return 1 << ((int(said.read().strip().removesuffix("K")) << 10).bit_length() - 1)
    except (OSError, ValueError):
        return 1 << 25


def run_counted(study, load):
    """What callgrind counted in one run of a workload, and the units done."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "callgrind")
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--dump-line=no",
             "--compress-pos=no", "--cache-sim=yes", f"--LL={last_cache_bytes()},16,64",
             "--toggle-collect=howl::limits::MeasuredRun*", f"--callgrind-out-file={out}", study,
             "--once", load], capture_output=True, text=True)
        if run.returncode != 0:
            raise SystemExit(f"{load}: {run.stderr}")
        return read_callgrind(out), float(run.stdout)


def count(study, load):
    """Of one unit: operations of the program's own code by (kind, lanes), operations in all, calls
    of the C library by name, bytes that pass beyond the first cache and beyond the last."""
    (runs, calls, totals), units = run_counted(study, load)
    own, functions = collections.Counter(), collections.Counter()
    everywhere = 0.0
    listings = {}
    for (path, address), times in runs.items():
        if path not in listings:
            listings[path] = disassembled(path) if os.path.exists(path) else {}
        does = listings[path].get(address)
        if does:
            kind, lanes, operations = does
            everywhere += times * operations / units
            if not LIBRARY.search(path):
                own[kind, lanes] += times * operations / units
    for function, times in calls.items():
        entry = entry_called(function)
        if entry:
            functions[entry] += times / units
    return {"own": own, "all": everywhere, "calls": functions,
            "instructions": totals["Ir"] / units,
            "beyond_first_cache": 64.0 * (totals["D1mr"] + totals["D1mw"]) / units,
            "memory": 64.0 * (totals["DLmr"] + totals["DLmw"]) / units}


# Entries of the C library as the program calls them; what they call inside is a part of them.
ENTRIES = ["exp", "log", "pow", "sin", "cos", "sincos", "tan", "asin", "atan", "atan2", "hypot",
           "tanh", "fesetround"]


def entry_called(name):
    """The entry that a function of the C library is, under any of its names; None for others."""
    if name in ALLOCATORS:
        return "malloc"
    found = re.match(r"^(?:__GI___|__)?([a-z]+[0-9]?)(?:@@?GLIBC\S*)?(?:_fma|_fma4|_sse2|_avx2)?$",
                     name)
    if not found or found[1] not in ENTRIES:
        return None
    return found[1]
