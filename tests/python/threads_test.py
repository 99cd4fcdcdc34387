"""Threads, signals and processes."""

import numpy as np
import restlab

COMMON = """
import os, signal, threading
import numpy as np
import restlab
restlab.set_verbosity(-1)
session = restlab.Session("cornell-box", width=16, height=16, threads=1)

def is_busy():
    try:
        return session.frame_count < 0
    except restlab.Error as error:
        assert "one thread at a time" in str(error)
        return True
"""


def test_another_thread_is_refused_and_ctrl_c_ends_both(script):
    # Without the lock released, the main thread would wait for a billion frames.
    out = script(
        COMMON
        + """
caught = []
def render():
    try:
        session.frames(10**9)
    except restlab.Error as error:
        caught.append((error.exit_code, str(error)))
thread = threading.Thread(target=render)
thread.start()
while not is_busy():
    pass
try:
    session.frame()
except restlab.Error as error:
    print(error)
try:
    os.kill(os.getpid(), signal.SIGINT)
    thread.join()
    signal.pause()
except KeyboardInterrupt:
    thread.join()
    print("interrupted", caught[0][0])
session.frame()
again = session.radiance()
fresh = restlab.Session("cornell-box", width=16, height=16, threads=1)
fresh.frame()
print(np.array_equal(again, fresh.radiance()), session.frame_count)
"""
    )
    lines = out.splitlines()
    assert "used by another thread" in lines[0]
    assert lines[1:] == ["interrupted 130", "True 1"]


def test_ctrl_c_ends_a_frame_of_the_main_thread(script):
    out = script(
        COMMON
        + """
def interrupt():
    while not is_busy():
        pass
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    session.frames(10**9)
except KeyboardInterrupt:
    print("interrupted")
try:
    session.radiance()
except restlab.Error as error:
    print(error)
session.frame()
try:
    os.kill(os.getpid(), signal.SIGINT)  # where no frame is under way
    signal.pause()
except KeyboardInterrupt:
    session.frame()
    print(session.frame_count)
"""
    )
    assert out.splitlines() == [
        "interrupted",
        "radiance: this history has no frame yet; call frame() first",
        "2",
    ]


def test_sessions_of_several_threads_are_independent(script):
    out = script(
        COMMON
        + """
images = {}
def render(seed):
    own = restlab.Session("cornell-box", width=16, height=16, threads=1, seed=seed)
    own.frames(20)
    images[seed] = own.radiance()
threads = [threading.Thread(target=render, args=(seed,)) for seed in (1, 2, 3)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
for seed in (1, 2, 3):
    session.reset(seed)
    session.frames(20)
    print(np.array_equal(images[seed], session.radiance()))
"""
    )
    assert out.split() == ["True"] * 3


def test_a_forked_process_is_told_so(script):
    out = script(
        COMMON
        + """
session.frame()
child = os.fork()
if child == 0:
    try:
        session.frame()
    except restlab.Error as error:
        print(error, flush=True)
    os._exit(0)
os.waitpid(child, 0)
"""
    )
    assert "forked" in out and "spawn" in out
