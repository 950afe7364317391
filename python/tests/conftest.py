"""Fixtures used by several test files."""

import signal
import threading

import pytest


@pytest.fixture
def interrupted():
    """A call that a signal must end. A thread sends a signal whenever the last one was handled; the fourth raises KeyboardInterrupt, which a call
    that handles signals only at its end never sees."""

    def end(call):
        over, handled, main = threading.Event(), threading.Semaphore(0), threading.get_ident()
        count = 0

        def handle(*_):
            nonlocal count
            count += 1
            handled.release()
            if count == 4:
                over.set()
                raise KeyboardInterrupt

        def send():
            while not over.is_set():
                signal.pthread_kill(main, signal.SIGUSR1)
                handled.acquire()

        before = signal.signal(signal.SIGUSR1, handle)
        thread = threading.Thread(target=send)
        try:
            with pytest.raises(KeyboardInterrupt):
                thread.start()
                call()
                over.set()
        finally:
            thread.join()
            signal.signal(signal.SIGUSR1, before)

    return end
