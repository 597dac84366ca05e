import threading

from drivers.modbus.fair_lock import FairLock

DEADLINE_S = 5.0


def test_turns_go_in_the_order_of_arrival_also_before_who_comes_again():
    lock, order = FairLock(), []

    def once(name):
        with lock:
            order.append(name)

    threads = [threading.Thread(target=once, args=(name,)) for name in ("second", "third")]
    with lock:
        for waiting, thread in enumerate(threads, 1):
            thread.start()
            _stand_in_line(lock, waiting)
        order.append("first")
    with lock:
        order.append("first again")
    for thread in threads:
        thread.join(DEADLINE_S)
    assert order == ["first", "second", "third", "first again"]


def test_one_at_a_time():
    lock, inside, most = FairLock(), [0], [0]

    def work():
        for _ in range(200):
            with lock:
                inside[0] += 1
                most[0] = max(most[0], inside[0])
                inside[0] -= 1

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(DEADLINE_S)
    assert not any(thread.is_alive() for thread in threads)
    assert most == [1]


def _stand_in_line(lock, count):
    tick = threading.Event()
    for _ in range(5000):
        if lock.waiting == count:
            return
        tick.wait(0.001)
    raise AssertionError(f"{lock.waiting} in line, {count} expected")
