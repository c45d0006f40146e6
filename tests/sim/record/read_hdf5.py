"""read_hdf5.py TRACE.h5 TRACE.csv EVENTS.csv: h5py and pandas find in the one what stands in the others."""

import sys

import h5py
import pandas

hdf5, trace, events = sys.argv[1:]
csv = pandas.read_csv(trace, dtype=float, float_precision="round_trip")
with h5py.File(hdf5) as file:
    channels = file["channels"]
    names = [f"{name} [{data.attrs['unit'].decode() or '-'}]" for name, data in channels.items()]
    assert names == list(csv.columns[1:]), (names, list(csv.columns))
    assert file["time"].attrs["unit"] == b"s"
    frame = pandas.DataFrame({name: data[:] for name, data in zip(names, channels.values())})
    frame.insert(0, "time [s]", file["time"][:])
    pandas.testing.assert_frame_equal(frame, csv, check_exact=True)
    for data in channels.values():
        assert data.shuffle and data.compression == "gzip" and data.chunks, data

    told = pandas.DataFrame(file["events"][:])
    lines = pandas.read_csv(events)
    assert told.id.nunique() == len(lines), (told.id.nunique(), len(lines))
    cuts = told[(told.event == b"cut") & (told.name == b"length")]
    lengths = lines[lines.event == "cut"]["values"].str.extract(r"length=(\S+) mm")[0].astype(float)
    assert len(cuts) == len(lengths) > 2 and (cuts.unit == b"mm").all()
    assert (abs(cuts.value.values - lengths.values) < 1e-5).all()

    checks = pandas.DataFrame(file["checks"][:])
    assert b"cut length" in list(checks.name), checks
    assert file.attrs["step"] == b"100 us" and b"scene.seed=3" in file.attrs["set"]
    assert b"plants:" in file.attrs["scenario"]
print("equal")
