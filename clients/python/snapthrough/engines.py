"""Executors of engines that have none of their own; see docs/howto/engines.md.

Most engines need nothing from here: `Local().sweep(document, executor=...)` takes any concurrent.futures.Executor.
"""
import multiprocessing
from concurrent.futures import Executor, ProcessPoolExecutor
from typing import Callable, Optional

from ._engine import available_cores

__all__ = ["joblib_workers", "processes"]


def processes(workers: Optional[int] = None) -> Callable[[], Executor]:
    """Makes pools of processes of the standard library, one a core by default.

    What is returned is a function, so that a pool with a worker that died is replaced. Processes are started anew
    (spawn), not forked: a fork copies the locks of other threads as they are.
    """
    def make() -> Executor:
        return ProcessPoolExecutor(workers or available_cores(), mp_context=multiprocessing.get_context("spawn"))

    return make


def joblib_workers(workers: Optional[int] = None) -> Callable[[], Executor]:
    """Makes the executor of joblib's own workers (loky), one a core by default.

    joblib keeps them and uses them again for its Parallel; a pool with a worker that died is replaced.
    """
    def make() -> Executor:
        from joblib.externals.loky import get_reusable_executor
        executor: Executor = get_reusable_executor(max_workers=workers or available_cores())
        return executor

    return make
