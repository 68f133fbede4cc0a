"""A sweep by MPI: mpiexec -n 3 python3 -m mpi4py.futures with_mpi.py sweep.json table.json"""
import pathlib
import sys
import time

from mpi4py.futures import MPIPoolExecutor

import snapthrough

if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        list(executor.map(time.sleep, [0.5] * 2))  # the workers are there
        start = time.perf_counter()
        run = snapthrough.Local().sweep(pathlib.Path(sys.argv[1]).read_bytes(), executor=executor, workers=2)
        run.table().to_json(sys.argv[2])
        pathlib.Path(sys.argv[2] + ".seconds").write_text(str(time.perf_counter() - start), encoding="utf-8")
