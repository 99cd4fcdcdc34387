"""Threads, signals and processes."""

import numpy as np
import restlab

COMMON = """
import os, signal, sys, threading
import numpy as np
import restlab
restlab.set_verbosity(-1)
session = restlab.Session("cornell-box", width=16, height=16, threads=1)

def is_busy(one=session):
    try:
        return one.frame_count < 0
    except restlab.Error as error:
        assert "one thread at a time" in str(error)
        return True
"""


def test_another_thread_is_refused_and_the_exit_ends_it(script):
    # Without the lock released, the main thread would wait for a billion frames.
    out = script(
        COMMON
        + """
def render():
    try:
        session.frames(10**9)
    finally:
        while True:  # refused, again and again, until the interpreter is gone
            try:
                session.frame()
            except restlab.Error as error:
                assert error.exit_code == 130, error
threading.Thread(target=render, daemon=True).start()
while not is_busy():
    pass
try:
    session.frame()
except restlab.Error as error:
    print(error)
"""
    )
    assert "used by another thread" in out


def test_the_exit_waits_for_short_calls(script):
    # Without numpy: three threads that load it at once must not wait for each other.
    for _ in range(3):
        out = script(
            """
import threading
import restlab
restlab.set_verbosity(-1)
done = []
def render():
    own = restlab.Session("cornell-box", width=16, height=16, threads=1)
    while True:
        own.frame()
        restlab.metric("mse", own.radiance(), own.aov("depth"))
        done.append(1)
for _ in range(3):
    threading.Thread(target=render, daemon=True).start()
while len(done) < 20:
    pass
print("end")
"""
        )
        assert out == "end\n"


def test_ctrl_c_ends_the_main_thread_alone(script):
    out = script(
        COMMON
        + """
other = restlab.Session("cornell-box", width=16, height=16, threads=1)
ends, left = threading.Event(), []
def render():
    while not ends.is_set():
        other.frames(10)
    left.append(other.frame_count % 10)
def interrupt():
    while not is_busy():
        pass
    os.kill(os.getpid(), signal.SIGINT)
thread = threading.Thread(target=render)
thread.start()
threading.Thread(target=interrupt).start()
try:
    session.frames(10**9)
except KeyboardInterrupt:
    print("interrupted")
try:
    session.radiance()
except restlab.Error as error:
    print(error)
session.frame()  # the other thread renders still
ends.set()
thread.join()
print(session.frame_count, left)
fresh = restlab.Session("cornell-box", width=16, height=16, threads=1)
fresh.frame()
print(np.array_equal(session.radiance(), fresh.radiance()))
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
        "1 [0]",
        "True",
        "2",
    ]


def test_a_handler_may_fork(script):
    out = script(
        COMMON
        + """
def fork(*_):
    child = os.fork()
    if child == 0:
        raise SystemExit(7)
    children.append(child)
def alarm():
    while not is_busy():
        pass
    os.kill(os.getpid(), signal.SIGALRM)
children = []
signal.signal(signal.SIGALRM, fork)
threading.Thread(target=alarm, daemon=True).start()
while not children:
    session.frames(100)
print(os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1]))
"""
    )
    assert out == "7\n"


def test_a_handler_decides_whether_a_frame_ends(script):
    out = script(
        COMMON
        + """
class Enough(Exception):
    pass
def note(*_):
    notes.append("noted")
def leave(*_):
    raise Enough
def interrupt():
    while not is_busy():
        pass
    os.kill(os.getpid(), signal.SIGINT)
notes = []
signal.signal(signal.SIGINT, note)
threading.Thread(target=interrupt).start()
frames = 0
while not notes:
    frames += len(session.frames(100))
print(frames % 100, notes)
signal.signal(signal.SIGINT, leave)
threading.Thread(target=interrupt).start()
try:
    session.frames(10**9)
except Enough:
    print("left")
"""
    )
    assert out.splitlines() == ["0 ['noted']", "left"]


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


def test_a_forked_process_opens_sessions_of_its_own(script):
    out = script(
        COMMON
        + """
session.frame()
other = restlab.Session("cornell-box", width=16, height=16, threads=1)
def render():
    other.frames(10**9)
def refused(call):
    try:
        call()
    except restlab.Error as error:
        print(error, flush=True)
def child(*calls):
    if os.fork() > 0:
        assert os.wait()[1] == 0
        return
    for call in calls:
        call()
    sys.exit()  # waits for no call of the parent
def own():
    fresh = restlab.Session("cornell-box", width=16, height=16, threads=1)
    fresh.frame()
    print(np.array_equal(fresh.radiance(), session_image), flush=True)
session_image = session.radiance()
child(lambda: refused(session.frame), own)
restlab.backends()
child(lambda: refused(lambda: restlab.Session("furnace", backend="vulkan")))
threading.Thread(target=render, daemon=True).start()
while not is_busy(other):
    pass
child(lambda: refused(own))
"""
    )
    lines = out.splitlines()
    assert "before this process was forked" in lines[0] and lines[1] == "True"
    assert "vulkan" in lines[2] and "spawn" in lines[2]
    assert "while a thread" in lines[3] and "spawn" in lines[3]
