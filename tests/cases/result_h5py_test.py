"""result_h5py_test.py DIR: h5py reads the known result that make_result wrote into DIR.

Exit codes: 0 read as expected, 77 no h5py here, otherwise a failure.
"""
import sys
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PARTICLES = 7
TIMES = [0, 5e-4, 1e-3]


def main(directory: Path) -> None:
    print(f"h5py {h5py.version.version}, HDF5 {h5py.version.hdf5_version}")
    i = np.arange(PARTICLES)
    with h5py.File(directory / "result.h5", "r") as file:
        ice = file["VTKHDF"]
        assert bytes(ice.attrs["Type"]) == b"PolyData" and list(ice.attrs["Version"]) == [2, 0]
        assert ice["Steps"].attrs["NSteps"] == len(TIMES)
        assert list(ice["Steps/Values"]) == TIMES
        assert ice["Points"].shape == (len(TIMES) * PARTICLES, 3) and ice["Points"].dtype == "<f8"
        for step, t in enumerate(TIMES):
            rows = slice(ice["Steps/PointOffsets"][step], ice["Steps/PointOffsets"][step] + ice["NumberOfPoints"][0])
            assert np.array_equal(ice["Points"][rows], np.stack([i, 2 * i + 100 * t, -i], axis=1))
            assert np.array_equal(ice["PointData/pressure_Pa"][rows], (1000 * i + t).astype("f4"))
            assert np.array_equal(ice["PointData/velocity_m_s"][rows], np.stack([0 * i, 0 * i + 100, i], axis=1))

        body = file["bodies/hcc"]
        assert list(body["time"]) == TIMES
        assert np.array_equal(body["position"][:, 2], [-1 + 80 * t for t in TIMES])
        assert np.array_equal(body["orientation_wxyz"], [[0, 1, 0, 0]] * len(TIMES))
        assert body["traction_Pa"].shape == (len(TIMES), 2, 3)
        assert np.array_equal(body["traction_Pa"][2, 1], [1, 0, -1e6 * TIMES[2]])
        assert np.array_equal(body["boundary/area_m2"], [0.5, 0.125])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
