# SPDX-License-Identifier: GPL-3.0-or-later
"""The system calls that the manufacturer's SDK makes, in its order, with its waits: whoever uses it sees a bus like any.

It opens a port twice at the start (once at its default rate), never blocks, forgets what came before each request, asks
again and again for the bytes that are still missing, and gives up after the bytes' time and 34 ms."""
import errno
import unittest

from stranger import *

ID, LED, TORQUE, GOAL, PRESENT = 7, 65, 64, 116, 132
LATENCY_TIMER = 16  # ms, as it takes for granted


def again_and_again(seconds=20):
    """As often as it takes: the SDK waits for 34 ms, in which a busy machine may not give the simulator its turn."""
    end = time.time() + seconds
    while time.time() < end:
        yield


class SdkPort:
    def __init__(self, path, drains=False):
        self.path, self.fd, self.drains = path, -1, drains
        self.set_baud(57600)

    def set_baud(self, baud):
        self.close()
        standard = getattr(termios, "B%d" % baud, None)
        self.setup(standard if standard is not None else termios.B38400)
        if standard is None:
            settings = bytearray(fcntl.ioctl(self.fd, TCGETS2, bytes(44)))
            flags = struct.unpack_from("<I", settings, 8)[0]
            struct.pack_into("<I", settings, 8, flags & ~0o010017 | BOTHER)
            struct.pack_into("<2I", settings, 36, baud, baud)
            fcntl.ioctl(self.fd, TCSETS2, bytes(settings))
        self.byte_time = 10000 / baud  # ms

    def setup(self, standard):
        self.fd = os.open(self.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        characters = [b"\0"] * 32  # VMIN and VTIME, too: a read never waits
        termios.tcflush(self.fd, termios.TCIFLUSH)
        termios.tcsetattr(self.fd, termios.TCSANOW, [
            termios.IGNPAR, 0, termios.CS8 | termios.CLOCAL | termios.CREAD, 0, standard, standard, characters])

    def close(self):
        if self.fd >= 0:
            os.close(self.fd)
        self.fd = -1

    def transmit(self, request):
        if self.drains:
            termios.tcdrain(self.fd)  # the Python one, up to version 4.0.4
        else:
            termios.tcflush(self.fd, termios.TCIFLUSH)
        return os.write(self.fd, request) == len(request)

    def read_some(self, size):
        try:
            return os.read(self.fd, size)
        except BlockingIOError:
            return b""

    def wait_for(self, size):
        self.end = time.time() + (self.byte_time * size + 2 * LATENCY_TIMER + 2) / 1000

    def packet(self, highest_id=252):
        """A whole one, or None. What it can't begin with is dropped byte by byte."""
        data, wanted = b"", 11
        while True:
            data += self.read_some(wanted - len(data))
            if len(data) < wanted:
                if time.time() > self.end:
                    return None
                continue
            size = 7 + struct.unpack_from("<H", data, 5)[0]
            begins = data[:4] == b"\xff\xff\xfd\x00" and data[4] <= highest_id and size <= 1024 and data[7] == STATUS
            if not begins:
                data = data[1:]
            elif size > len(data):
                wanted = size
            else:
                return data if crc(data[:-2]) == struct.unpack_from("<H", data, size - 2)[0] else None

    def ask(self, request, answer=11):
        if not self.transmit(request):
            return None
        self.wait_for(answer)
        heard = self.packet()
        return split(heard)[0][0] if heard else None

    def patiently(self, request, answer=11):
        """A busy machine may be later than the SDK waits; a program asks again then. What comes may be the answer to
        what was asked before, which the SDK takes for this one's."""
        for _ in again_and_again():
            status = self.ask(request, answer)
            if status and len(status.data) == answer - 11:
                return status
        return None

    def group(self, request, ids, size):
        for _ in again_and_again():
            self.transmit(request)
            self.wait_for((11 + size) * len(ids))
            found = []
            for device in ids:
                heard = self.packet()
                if not heard or heard[4] != device:
                    break
                found.append((device, unstuff(heard[7:-2])[2:]))
            if len(found) == len(ids):
                return found
        return None

    def broadcast_ping(self):
        self.transmit(packet(BROADCAST, PING))
        end = time.time() + (14 * 252 * self.byte_time + 3 * 252 + 16) / 1000
        data = b""
        while time.time() < end:
            data += self.read_some(14 * 252 - len(data))
        return [(status.id, status.data) for status in split(data)[0]]


class TheSdk(unittest.TestCase):
    drains = False

    def serve(self, devices):
        self.sim = Sim("--devices", devices)
        self.addCleanup(self.sim.stop)
        self.port = SdkPort(self.sim.path, self.drains)
        self.addCleanup(self.port.close)
        return self.port

    def test_at_standard_and_custom_rates(self):
        port = self.serve(",".join("XM430-W350@%d:%d" % (baud, 1 + i)
                                   for i, baud in enumerate((57600, 1000000, 4000000, 4500000))))
        for device, baud in ((1, 57600), (2, 1000000), (3, 4000000), (4, 4500000), (1, 57600)):
            with self.subTest(baud):
                port.set_baud(baud)
                self.assertEqual(port.patiently(packet(device, PING), 14).data, u16(1020) + u8(45))
                self.assertEqual(port.patiently(packet(device, WRITE, u16(LED), u8(1))).error, 0)
                self.assertEqual(port.patiently(packet(device, READ, u16(LED, 1)), 12).data, u8(1))

    def test_groups_of_twenty(self):
        ids = list(range(1, 21))
        port = self.serve(",".join("XM430-W350@1000000:%d" % device for device in ids))
        port.set_baud(1000000)
        goals = b"".join(u8(device) + u32(2000 + device) for device in ids)
        self.assertTrue(port.transmit(packet(BROADCAST, SYNC_WRITE, u16(GOAL, 4), goals)))
        expected = [(device, u32(2000 + device)) for device in ids]
        self.assertEqual(port.group(packet(BROADCAST, SYNC_READ, u16(GOAL, 4), u8(*ids)), ids, 4), expected)
        spans = b"".join(u8(device) + u16(GOAL, 4) for device in ids)
        self.assertEqual(port.group(packet(BROADCAST, BULK_READ, spans), ids, 4), expected)
        for _ in again_and_again():
            port.transmit(packet(BROADCAST, FAST_SYNC_READ, u16(GOAL, 4), u8(*ids)))
            port.wait_for((11 + 4) * len(ids))
            heard = port.packet(highest_id=BROADCAST)
            if heard:
                break
        blocks = [heard[8 + 8 * i:8 + 8 * i + 6] for i in range(len(ids))]
        self.assertEqual(blocks, [u8(0, device) + goal for device, goal in expected])

    def test_broadcast_ping(self):
        port = self.serve("XM430-W350@1000000:1,XL430-W250@1000000:7,XM430-W350@1000000:30")
        port.set_baud(1000000)
        expected = [(1, u16(1020) + u8(45)), (7, u16(1060) + u8(45)), (30, u16(1020) + u8(45))]
        self.assertTrue(until(lambda: port.broadcast_ping() == expected, 15))

    def test_reboot_and_factory_reset(self):
        port = self.serve("XM430-W350@57600:5")
        for request in (packet(5, REBOOT), packet(5, FACTORY_RESET, u8(2))):
            self.assertEqual(port.patiently(request).error, 0)
            self.assertTrue(until(lambda: port.ask(packet(5, PING), 14), 10))

    def test_low_latency_is_refused_as_by_many_adapters(self):
        port = self.serve("XM430-W350@57600:1")
        with self.assertRaises(OSError) as refused:  # a program has to go on without it, as with a CDC-ACM adapter
            fcntl.ioctl(port.fd, 0x541E, bytes(72))  # TIOCGSERIAL
        self.assertEqual(refused.exception.errno, errno.ENOTTY)
        self.assertEqual(port.patiently(packet(1, PING), 14).id, 1)


class ThePythonSdk(TheSdk):
    drains = True


if __name__ == "__main__":
    unittest.main()
