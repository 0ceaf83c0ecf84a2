"""result_paraview_test.py DIR: ParaView opens result.xmf of the known result that make_result wrote into DIR, and where
its VTKHDF reader knows temporal PolyData (ParaView 5.12 and later), result.h5 too.

Started by any Python, goes on inside pvbatch. Exit codes: 0 read as expected, 77 no pvbatch here, otherwise a failure.
"""
import os
import shutil
import sys

PARTICLES = 7
TIMES = [0, 5e-4, 1e-3]


def check(reader, name):
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    reader.UpdatePipelineInformation()
    assert list(reader.TimestepValues) == TIMES, (name, list(reader.TimestepValues))
    # Not in order: each time must be found by itself.
    for t in (TIMES[1], TIMES[2], TIMES[0]):
        reader.UpdatePipeline(t)
        data = servermanager.Fetch(reader)
        while data.IsA("vtkCompositeDataSet"):
            data = data.GetBlock(0)
        assert data.GetNumberOfPoints() == PARTICLES, (name, t, data.GetNumberOfPoints())
        assert data.GetNumberOfCells() == PARTICLES, (name, t, data.GetNumberOfCells())
        assert data.GetCell(3).GetPointId(0) == 3, (name, t)
        points = vtk_to_numpy(data.GetPoints().GetData())
        pressure = vtk_to_numpy(data.GetPointData().GetArray("pressure_Pa"))
        velocity = vtk_to_numpy(data.GetPointData().GetArray("velocity_m_s"))
        for i in range(PARTICLES):
            assert list(points[i]) == [i, 2 * i + 100 * t, -i], (name, t, i, points[i])
            assert abs(pressure[i] - (1000 * i + t)) <= 1e-7 * 1000 * i + 1e-10, (name, t, i, pressure[i])
            assert list(velocity[i]) == [0, 100, i], (name, t, i, velocity[i])
    print(f"{name}: {PARTICLES} particles at {len(TIMES)} times, as written")


def main(directory):
    from paraview import simple

    version = simple.GetParaViewVersion()
    print(simple.GetParaViewSourceVersion())
    check(simple.XDMFReader(FileNames=[os.path.join(directory, "result.xmf")]), "XDMF 2 reader")
    if (version.major, version.minor) >= (5, 12):
        check(simple.VTKHDFReader(FileName=[os.path.join(directory, "result.h5")]), "VTKHDF reader")


if __name__ == "__main__":
    if os.environ.get("NILAS_TEST_INSIDE_PVBATCH"):
        try:
            main(sys.argv[1])
        except BaseException as failure:  # pvbatch does not pass on every failure in its exit code
            print("failed:", repr(failure))
            sys.stdout.flush()
            os._exit(1)
        sys.stdout.flush()
        os._exit(0)
    pvbatch = shutil.which("pvbatch")
    if pvbatch is None:
        print("skipped: no pvbatch")
        sys.exit(77)
    os.environ["NILAS_TEST_INSIDE_PVBATCH"] = "1"
    os.execv(pvbatch, [pvbatch, os.path.abspath(__file__), sys.argv[1]])
