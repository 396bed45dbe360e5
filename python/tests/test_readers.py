"""One record in many formats is the same doubles."""

import gzip

import numpy as np
import pandas as pd
import pytest

import howl


@pytest.fixture(scope="module")
def record():
    random = np.random.default_rng(1)
    return pd.DataFrame({"p": random.normal(size=500) * 256.0, "q": random.normal(size=500) / 3.0})


def text(frame, separator, header=True):
    rows = [separator.join(frame.columns)] if header else []
    rows += [separator.join(map(repr, map(float, row))) for row in frame.to_numpy()]
    return "\n".join(rows) + "\n"


def write_csv(frame, path):
    path.write_text(text(frame, ","))


def write_semicolons(frame, path):
    path.write_text(text(frame, ";"))


def write_tabs(frame, path):
    path.write_text("# a comment\n" + text(frame, "\t"))


def write_gzip(frame, path):
    with gzip.open(path, "wt") as stream:
        stream.write(text(frame, ","))


def write_npz(frame, path):
    np.savez(path, sampling_hz=5000.0, **{name: frame[name].to_numpy() for name in frame})


def write_npy(frame, path):
    rows = [tuple(row) for row in frame.to_numpy()]
    np.save(path, np.array(rows, dtype=[("p", "f8"), ("q", "f8")]))


def write_mat(frame, path):
    scipy_io = pytest.importorskip("scipy.io")
    scipy_io.savemat(path, {"p": frame["p"].to_numpy(), "q": frame["q"].to_numpy(), "fs": 5000.0})


def write_hdf5(frame, path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as stream:
        for name in frame:
            stream[name] = frame[name].to_numpy()


def write_mat73(frame, path):
    """HDF5 behind MATLAB's own header, each variable with its class, as version 7.3 has them."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w", userblock_size=512) as stream:
        for name in frame:
            stream[name] = frame[name].to_numpy()[np.newaxis, :]
            kind = h5py.h5t.C_S1.copy()  # text that ends with a zero, as MATLAB writes it
            kind.set_size(7)
            space = h5py.h5s.create(h5py.h5s.SCALAR)
            attribute = h5py.h5a.create(stream[name].id, b"MATLAB_class", kind, space)
            attribute.write(np.array(b"double", dtype="S7"), mtype=kind)
    with open(path, "r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8) + b"\0\2IM")


def write_parquet(frame, path):
    pyarrow = pytest.importorskip("pyarrow")
    import pyarrow.parquet as parquet

    table = pyarrow.Table.from_pandas(frame.assign(note="text"), preserve_index=False)
    parquet.write_table(table.replace_schema_metadata({b"sampling_hz": b"5000"}), path)


def write_tdms(frame, path):
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment([
            nptdms.ChannelObject("rig", name, frame[name].to_numpy(), {"wf_increment": 2e-4})
            for name in frame])


def write_uff(frame, path):
    pyuff = pytest.importorskip("pyuff")
    for name in frame:  # pyuff loses what came before where it overwrites binary sets
        one = pyuff.prepare_58(
            binary=1, func_type=1, rsp_node=1, rsp_dir=1, ref_dir=1, ref_node=1,
            data=frame[name].to_numpy(), x=np.arange(len(frame)) * 2e-4, id1=name,
            rsp_ent_name=name, ref_ent_name=name, abscissa_spacing=1, abscissa_spec_data_type=17,
            ordinate_spec_data_type=0, orddenom_spec_data_type=0)
        pyuff.UFF(str(path)).write_sets(one, "add")


FORMATS = [
    ("a.csv", write_csv, None), ("a.txt", write_semicolons, None), ("a.dat", write_tabs, None),
    ("a.csv.gz", write_gzip, None), ("a.npz", write_npz, 5000), ("a.npy", write_npy, None),
    ("a.mat", write_mat, 5000), ("a73.mat", write_mat73, None), ("a.h5", write_hdf5, None),
    ("a.parquet", write_parquet, 5000), ("a.tdms", write_tdms, 5000), ("a.uff", write_uff, 5000),
]
# What the program reads itself; the others it reads once they are converted.
NATIVE = {"a.csv", "a.txt", "a.dat", "a.csv.gz", "a.mat", "a73.mat", "a.h5"}


@pytest.mark.parametrize("name, write, rate", FORMATS, ids=[name for name, _, _ in FORMATS])
def test_a_file_is_read_to_the_bit(name, write, rate, record, tmp_path):
    write(record, tmp_path / name)
    table = howl.read(tmp_path / name)
    assert list(table.columns) == ["p", "q"]
    for column in record:
        assert table[column].to_numpy().tobytes() == record[column].to_numpy().tobytes()
    assert table.attrs.get("sampling_hz") == rate
    if rate:
        assert table.index.name == "t_s" and table.index[5] == 5 / rate


@pytest.fixture(scope="module")
def answer(first_rig):
    return howl.analyse(first_rig["p"][0], first_rig["q"][0], sampling_hz=5000, phi=0.51,
                        name="lean")


@pytest.mark.parametrize("name, write, rate", FORMATS, ids=[name for name, _, _ in FORMATS])
def test_one_record_in_twelve_formats_has_one_answer(name, write, rate, first_rig, answer,
                                                     tmp_path):
    file = tmp_path / name
    write(pd.DataFrame({"p": first_rig["p"][0], "q": first_rig["q"][0]}), file)
    if name not in NATIVE:
        howl.readers.convert(file, tmp_path / "converted.csv")
        file = tmp_path / "converted.csv"
    found = howl.analyse({"experiments": [{"name": "lean", "phi": 0.51, "record": {
        "file": file, "pressure": "p", "heat_release": "q", "sampling_hz": 5000}}]})
    assert found.json == answer.json


def test_there_are_twelve_formats():
    assert len({name for name, _, _ in FORMATS}) == 12


@pytest.mark.parametrize("name", [name for name, _, _ in FORMATS if name not in NATIVE])
def test_the_program_says_how_to_convert_what_it_does_not_read(name, record, tmp_path):
    write = next(write for other, write, _ in FORMATS if other == name)
    write(record, tmp_path / name)
    with pytest.raises(howl.ConfigError, match=f"howl convert {name} a.csv") as caught:
        howl.analyse({"experiments": [{"name": "lean", "phi": 0.51, "record": {
            "file": tmp_path / name, "sampling_hz": 5000}}]})
    assert caught.value.file == str(tmp_path / name)


@pytest.mark.parametrize("ending", [".csv", ".csv.gz", ".mat", ".h5", ".npz", ".parquet"])
def test_what_is_converted_reads_back_to_the_bit(ending, record, tmp_path):
    write_npz(record, tmp_path / "in.npz")
    for needs in {".h5": ["h5py"], ".parquet": ["pyarrow"], ".mat": ["scipy"]}.get(ending, []):
        pytest.importorskip(needs)
    target = tmp_path / f"out{ending}"
    howl.readers.convert(tmp_path / "in.npz", target)
    table = howl.read(target)
    for column in record:
        assert table[column].to_numpy().tobytes() == record[column].to_numpy().tobytes()
    assert table.attrs.get("sampling_hz") == (None if "csv" in ending else 5000)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.npz", target.name]


def test_what_a_format_cannot_hold_is_said(record, tmp_path):
    np.savez(tmp_path / "in.npz", **{"channel 1": record["p"].to_numpy()})
    with pytest.raises(howl.ConfigError, match="MATLAB variable") as caught:
        howl.readers.convert(tmp_path / "in.npz", tmp_path / "out.mat")
    assert caught.value.key == "channel 1" and caught.value.file == str(tmp_path / "out.mat")
    (tmp_path / "damaged.npz").write_bytes(b"PK\x03\x04 and no more")
    with pytest.raises(howl.ConfigError, match="cannot be read as .npz"):
        howl.readers.convert(tmp_path / "damaged.npz", tmp_path / "out.csv")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["damaged.npz", "in.npz"]


def test_a_matrix_has_a_column_for_each_channel(record, tmp_path):
    np.save(tmp_path / "m.npy", record.to_numpy().T)
    table = howl.read(tmp_path / "m.npy", sampling_hz=2000)
    assert list(table.columns) == ["m:1", "m:2"] and table.index[-1] == 499 / 2000
    assert (table["m:2"].to_numpy() == record["q"].to_numpy()).all()


def test_text_without_a_header_has_numbered_columns(record, tmp_path):
    (tmp_path / "a.txt").write_text(text(record, "   ", header=False))
    table = howl.read(tmp_path / "a.txt")
    assert list(table.columns) == ["1", "2"] and len(table) == 500
    assert (table["1"].to_numpy() == record["p"].to_numpy()).all()


def test_integers_and_single_precision_become_doubles(tmp_path):
    counts = np.array([1, -32768, 7], dtype=np.int16)
    np.savez(tmp_path / "a.npz", p=counts, q=np.array([0.1, 0.2, 0.3], dtype=np.float32))
    table = howl.read(tmp_path / "a.npz")
    assert set(table.dtypes.astype(str)) == {"float64"} and list(table["p"]) == [1.0, -32768.0, 7.0]
    assert table["q"][0] == float(np.float32(0.1))


def test_what_cannot_be_read_is_said(tmp_path):
    np.savez(tmp_path / "a.npz", p=np.zeros(5), q=np.zeros(6))
    with pytest.raises(howl.ConfigError, match="p 5, q 6"):
        howl.read(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", note=np.array("text"))
    with pytest.raises(howl.ConfigError, match="no channel"):
        howl.read(tmp_path / "b.npz")
    (tmp_path / "a.csv").write_text("p;q\n0,5;1\n0,7;2\n")
    with pytest.raises(howl.ConfigError, match="decimal points") as caught:
        howl.read(tmp_path / "a.csv")
    assert caught.value.key == "p"
    with pytest.raises(howl.ConfigError, match="no such file"):
        howl.read(tmp_path / "none.csv")
