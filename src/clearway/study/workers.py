"""Where rows are computed: processes of this machine, or a Dask cluster."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any
from urllib.parse import urlsplit


@dataclass(frozen=True)
class Crew:
    """An executor, how many calls it takes on at a time, and how it tells of a dead worker."""

    executor: Executor
    slots: int
    deaths: tuple[type[Exception], ...]


Workers = Callable[[], AbstractContextManager[Crew]]
"""Opens a crew; leaving its context by an error ends all of its work at once."""


def local(jobs: int) -> Workers:
    """Return processes of this machine.

    Raises
    ------
    ValueError
        If ``jobs`` is below 1.
    """
    if jobs < 1:
        raise ValueError(f"jobs: must be 1 or more, got {jobs}")
    return partial(_local, jobs)


@contextmanager
def _local(jobs: int) -> Iterator[Crew]:
    with processes(jobs) as pool:
        yield Crew(pool, jobs, (BrokenExecutor,))


@contextmanager
def processes(jobs: int) -> Iterator[Executor]:
    """Yield a pool of processes, which end at once where the block is left by an error."""
    others = set(multiprocessing.active_children())
    pool = _Pool(jobs, multiprocessing.get_context("spawn"), initializer=_end_with_parent)
    try:
        yield pool
    except BaseException:
        for process in set(multiprocessing.active_children()) - others:
            process.kill()
        pool.shutdown(wait=False, cancel_futures=True)
        raise
    pool.shutdown()


class _Pool(ProcessPoolExecutor):
    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        # Workers are started here and inherit the mask, so that Ctrl-C reaches only the
        # process that hands out the work.
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return super().submit(fn, *args, **kwargs)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)


def _end_with_parent() -> None:
    """End this process when the one that started it is gone, however it went."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def cluster(address: str) -> Workers:
    """Return the workers of a Dask cluster, whose scheduler is at ``address``.

    Its workers need Clearway, the same version as here.

    Raises
    ------
    ValueError
        If the address is none, or Dask is not installed.
    """
    if not _is_address(address):
        raise ValueError(f"workers: {address!r} is no scheduler's address; write tcp://HOST:8786")
    try:
        import distributed  # noqa: F401
    except ImportError:
        raise ValueError(
            "workers: Dask is not installed; pip install 'clearway[cluster]'"
        ) from None
    return partial(_dask, address)


def _is_address(text: str) -> bool:
    try:
        parts = urlsplit(text)
        return bool(parts.scheme and parts.hostname and parts.port)
    except ValueError:  # a port that is no number
        return False


@contextmanager
def _dask(address: str) -> Iterator[Crew]:
    from distributed import Client, KilledWorker

    try:
        client = Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ValueError(
            f"workers: no Dask scheduler answers at {address} ({error}); "
            "start one with: dask scheduler, and workers with: dask worker ADDRESS"
        ) from None
    try:
        threads: dict[str, int] = client.nthreads()
        slots = max(sum(threads.values()), 1)
        yield Crew(client.get_executor(pure=False), slots, (KilledWorker, CancelledError))
    finally:
        # Forgets what is not done yet; the cluster belongs to others and goes on.
        client.close()
