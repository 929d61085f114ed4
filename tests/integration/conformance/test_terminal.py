# SPDX-License-Identifier: GPL-3.0-or-later
"""The terminal as programs use it, and the channel past it."""
import errno
import json
import os
import pathlib
import signal
import socket
import stat
import sys
import tempfile
import unittest

from stranger import *

LED, PRESENT = 65, 132
NOBODY = 65534


def ping(port, device=1):
    return port.one(packet(device, PING))


class Rates(unittest.TestCase):
    def test_standard(self):
        for baud in (9600, 57600, 115200, 1000000, 2000000, 3000000, 4000000):
            with self.subTest(baud):
                sim = Sim("--devices", "XM430-W350@%d:1" % baud)
                port = Port(sim.path, baud)
                self.assertEqual(ping(port).id, 1)
                port.close()
                sim.stop()

    def test_odd(self):
        sim = Sim("--devices", "XM430-W350@4500000:1")
        # 4.5 M itself, what an FTDI makes of it, and one that no UART would take for it.
        for baud, answered in ((4500000, True), (4571428, True), (4250000, False)):
            with self.subTest(baud):
                port = Port(sim.path, baud)
                self.assertEqual(bool(port.ask(packet(1, PING), 1, patience=3 if answered else 0.12)), answered)
                port.close()
        sim.stop()

    def test_changed_while_open(self):
        sim = Sim("--devices", "XM430-W350@57600:1,XM430-W350@1000000:2")
        port = Port(sim.path, 57600)
        self.assertEqual(ping(port, 1).id, 1)
        self.assertEqual(port.ask(packet(2, PING), 0), [])
        port.set_baud(1000000)
        self.assertEqual(ping(port, 2).id, 2)
        self.assertEqual(port.ask(packet(1, PING), 0), [])
        port.close()
        sim.stop()


class Terminal(unittest.TestCase):
    def setUp(self):
        self.sim = Sim("--devices", "XM430-W350@57600:1")

    def tearDown(self):
        self.sim.stop()

    def test_flushing(self):
        port = Port(self.sim.path)
        port.send(packet(1, PING))
        self.assertTrue(select.select([port.fd], [], [], 3)[0])
        self.assertTrue(until(lambda: self.pending(port) == 14))
        termios.tcflush(port.fd, termios.TCIFLUSH)
        self.assertEqual(self.pending(port), 0)
        self.assertEqual(ping(port).id, 1)  # what comes after is whole
        termios.tcflush(port.fd, termios.TCIOFLUSH)
        termios.tcdrain(port.fd)
        self.assertEqual(ping(port).id, 1)
        port.close()

    @staticmethod
    def pending(port):
        return struct.unpack("i", fcntl.ioctl(port.fd, termios.FIONREAD, bytes(4)))[0]

    def test_opened_again(self):
        for _ in range(5):
            port = Port(self.sim.path)
            self.assertEqual(ping(port).id, 1)
            port.close()

    def test_an_unread_answer_is_not_the_next_ones(self):
        port = Port(self.sim.path)
        port.send(packet(1, WRITE, u16(LED), u8(1)))
        port.close()
        port = Port(self.sim.path)
        self.assertTrue(until(lambda: port.read(1, LED, 1) == 1))
        port.close()

    def test_pieces(self):
        port = Port(self.sim.path)

        def in_pieces():  # a busy machine may pause too long between two of them
            for byte in packet(1, PING):
                port.send(u8(byte))
            return [answer.id for answer in split(port.receive(lambda data: len(data) >= 14, patience=0.5))[0]] == [1]
        self.assertTrue(until(in_pieces, 10))
        port.close()

    def test_a_long_pause_loses_the_packet(self):
        port = Port(self.sim.path)
        request = packet(1, PING)
        port.send(request[:5])
        time.sleep(0.1)  # the pause is what is tested
        port.send(request[5:])
        self.assertEqual(port.receive(lambda data: True, patience=0.15), b"")
        self.assertEqual(ping(port).id, 1)
        port.close()

    def test_two_bauds_hear_garbage(self):
        self.sim.stop()
        self.sim = Sim("--devices", "XM430-W350@57600:1,XM430-W350@57600:2", "--fault", "jitter=0ms")
        port = Port(self.sim.path, 115200)
        self.assertEqual(port.ask(packet(1, PING), 0), [])
        port.set_baud(57600)
        self.assertEqual(ping(port).id, 1)
        port.close()


class Pace(unittest.TestCase):
    def test_a_machine_that_is_too_slow_says_so(self):
        sim = Sim("--devices", "XM430-W350@9600:1")
        port = Port(sim.path, 9600)
        for _ in range(6):  # stopped in the middle of an answer, which takes 15 ms
            port.send(packet(1, PING))
            self.assertTrue(select.select([port.fd], [], [], 5)[0])
            sim.process.send_signal(signal.SIGSTOP)
            time.sleep(0.06)
            sim.process.send_signal(signal.SIGCONT)
            self.assertEqual(len(split(port.receive(lambda data: len(data) >= 14))[0]), 1)
        behind = lambda: not json.loads(sim.ctl("status")[1])["pacing"]["keepsUp"]
        self.assertTrue(until(behind, 10))
        pacing = json.loads(sim.ctl("status")[1])["pacing"]
        self.assertGreaterEqual(pacing["late"], 3)
        self.assertGreater(pacing["latenessUs"]["worst"], 10000)
        port.close()
        sim.process.terminate()
        self.assertIn(b"does not keep up", sim.process.communicate(timeout=30)[1])


@unittest.skipUnless(os.geteuid() == 0, "TIOCEXCL doesn't bind root: this needs root to become somebody else")
class NotRoot(unittest.TestCase):
    """The simulator and its clients as nobody, who is bound by exclusive locks."""
    wrapper = ("setpriv", "--reuid", str(NOBODY), "--regid", str(NOBODY), "--clear-groups")

    def setUp(self):
        try:
            self.sim = Sim("--devices", "XM430-W350@57600:1", wrapper=self.wrapper)
        except RuntimeError as error:
            self.skipTest("nobody may not run it here: %s" % error)
        # Nobody may read them there, wherever this tree is: root's own folder is closed to others.
        self.scripts = tempfile.TemporaryDirectory()
        os.chmod(self.scripts.name, 0o755)
        for source in pathlib.Path(__file__).resolve().parent.glob("*.py"):
            copy = pathlib.Path(self.scripts.name, source.name)
            copy.write_bytes(source.read_bytes())
            copy.chmod(0o644)

    def tearDown(self):
        self.sim.stop()
        self.scripts.cleanup()

    def client(self, *arguments):
        script = os.path.join(self.scripts.name, os.path.basename(__file__))
        return subprocess.Popen([*self.wrapper, sys.executable, "-B", script, *arguments, self.sim.path],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_killed_in_mid_poll_and_the_next(self):
        for _ in range(3):
            first = self.client("--poll-exclusively")
            self.assertEqual(first.stdout.readline(), b"polling\n")
            busy = self.client("--once")
            self.assertEqual(busy.communicate(timeout=30)[0].strip(), b"busy")
            first.send_signal(signal.SIGKILL)
            first.wait(30)
            first.stdout.close()
            second = self.client("--once")
            self.assertEqual(second.communicate(timeout=30)[0].strip(), b"answered")


class Links(unittest.TestCase):
    devices = ("--devices", "XM430-W350@57600:1")

    def test_a_clean_end(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with tempfile.TemporaryDirectory() as folder:
                link = os.path.join(folder, "servos")
                sim = Sim(*self.devices, "--link", link)
                self.assertEqual(os.readlink(link), sim.path)
                mode = os.stat(link + ".ctl").st_mode
                self.assertTrue(stat.S_ISSOCK(mode))
                self.assertEqual(stat.S_IMODE(mode), 0o600)
                sim.process.send_signal(number)
                self.assertEqual(sim.process.wait(30), 0)
                sim.stop()
                self.assertEqual(os.listdir(folder), [])

    def test_what_was_left_behind(self):
        with tempfile.TemporaryDirectory() as folder:
            link = os.path.join(folder, "servos")
            sim = Sim(*self.devices, "--link", link)
            sim.process.kill()
            sim.process.wait(30)
            sim.stop()
            self.assertEqual(sorted(os.listdir(folder)), ["servos", "servos.ctl"])
            sim = Sim(*self.devices, "--link", link)
            port = Port(link)
            self.assertEqual(ping(port).id, 1)
            port.close()
            with self.assertRaisesRegex(RuntimeError, "Another simulator"):
                Sim(*self.devices, "--link", link)
            self.assertEqual(os.readlink(link), sim.path)
            sim.stop()
            self.assertEqual(os.listdir(folder), [])

    def test_what_is_not_ours(self):
        with tempfile.TemporaryDirectory() as folder:
            link = os.path.join(folder, "file")
            pathlib.Path(link).write_text("precious")
            with self.assertRaisesRegex(RuntimeError, "not a symbolic link"):
                Sim(*self.devices, "--link", link)
            self.assertEqual(pathlib.Path(link).read_text(), "precious")
            other = os.path.join(folder, "other")
            os.symlink(link, other)
            with self.assertRaisesRegex(RuntimeError, "pseudo-terminal"):
                Sim(*self.devices, "--link", other)
            self.assertEqual(os.readlink(other), link)
            pathlib.Path(other + ".ctl").touch()
            with self.assertRaisesRegex(RuntimeError, "not a control socket"):
                Sim(*self.devices, "--link", other)


class ControlChannel(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.link = os.path.join(self.folder.name, "servos")
        self.sim = Sim("--devices", "XM430-W350@57600:1,XM430-W350@57600:2", "--link", self.link)
        self.port = Port(self.link)

    def tearDown(self):
        self.port.close()
        self.sim.stop()
        self.folder.cleanup()

    def ctl(self, *words):
        done = subprocess.run([Sim.program, "sim", "ctl", self.link, *words], capture_output=True, timeout=30)
        return done.returncode, done.stdout.decode().strip(), done.stderr.decode().strip()

    def test_faults(self):
        self.assertEqual(self.ctl("fault", "echo", "latency=4ms"), (0, "ok", ""))
        request = packet(1, PING)
        self.port.send(request)
        heard = self.port.receive(lambda data: len(data) >= len(request) + 14)
        self.assertEqual(heard[:len(request)], request)
        self.assertEqual(self.ctl("fault", "clear")[0], 0)
        self.assertEqual(ping(self.port).id, 1)
        self.assertEqual(self.ctl("fault", "dead-segment=2")[0], 0)
        self.assertEqual(self.port.ask(packet(2, PING), 0), [])
        self.assertEqual(ping(self.port).id, 1)
        self.assertEqual(self.ctl("fault", "clear")[0], 0)
        self.assertEqual(ping(self.port, 2).id, 2)

    def test_power_and_plugs(self):
        for off, on, silent in (("unplug 2", "plug 2", (2,)), ("power off", "power on", (1, 2)),
                                ("power off 1", "power on 1", (1,))):
            with self.subTest(off):
                self.port.write(1, LED, u8(1))
                self.assertEqual(self.ctl(*off.split())[0], 0)
                for device in silent:
                    self.assertEqual(self.port.ask(packet(device, PING), 0), [])
                self.assertEqual(self.ctl(*on.split())[0], 0)
                for device in (1, 2):
                    self.assertTrue(until(lambda: self.port.ask(packet(device, PING), 1, patience=0.1)))
                self.assertEqual(self.port.read(1, LED, 1), 0 if 1 in silent else 1)

    def test_the_adapter(self):
        self.assertEqual(self.ctl("unplug", "adapter")[0], 0)
        self.assertTrue(until(lambda: not os.path.exists(self.link)))
        self.assertEqual(self.port.receive(lambda data: False, patience=0.2), b"")
        self.port.close()
        self.assertEqual(self.ctl("plug", "adapter")[0], 0)
        self.assertTrue(until(lambda: os.path.exists(self.link)))
        self.port = Port(self.link)
        self.assertEqual(ping(self.port).id, 1)

    def test_truth_and_status(self):
        self.port.write(1, LED, u8(1))
        truth = json.loads(self.ctl("truth", "1")[1])
        self.assertEqual(truth["registers"]["LED"], 1)
        self.assertAlmostEqual(truth["physical"]["angle"], self.port.read(1, PRESENT, 4) * 360 / 4096, delta=0.3)
        self.assertEqual(len(json.loads(self.ctl("truth")[1])["servos"]), 2)
        status = json.loads(self.ctl("status")[1])
        self.assertEqual(status["port"], self.sim.path)
        self.assertGreaterEqual(status["pacing"]["replies"], 1)
        self.assertEqual([device["id"] for device in status["devices"]], [1, 2])
        self.assertIn("push", self.ctl("help")[1])

    def test_push(self):
        self.assertEqual(self.ctl("push", "1", "-0.5"), (0, "ok", ""))
        begin = self.port.read(1, PRESENT, 4)
        self.assertTrue(until(lambda: self.port.read(1, PRESENT, 4) != begin))

    def test_refusals(self):
        for words, says in ((["frobnicate"], "help"), (["push", "9", "1"], "No device is 9"), (["push", "1", "much"], "number"),
                            (["fault", "nonsense"], "no fault"), (["truth", "1", "2"], "truth")):
            code, out, error = self.ctl(*words)
            self.assertEqual((code, out), (2, ""))
            self.assertIn(says, error)

    def test_a_hostile_neighbour(self):
        with socket.socket(socket.AF_UNIX) as client:
            client.connect(self.link + ".ctl")
            client.sendall(b"x" * 100000 + b"\n\xff\xfe\x00\nstatus\n")
            answers = b""
            while answers.count(b"\n") < 3:
                answers += client.recv(65536)
            lines = answers.split(b"\n")
            self.assertIn(b"4096", lines[0])
            self.assertTrue(lines[1].startswith(b"error: "))
            self.assertTrue(lines[2].startswith(b"{"))
        # One that asks and never reads holds up nobody.
        with socket.socket(socket.AF_UNIX) as greedy:
            greedy.connect(self.link + ".ctl")
            greedy.setblocking(False)
            try:
                while True:
                    greedy.send(b"truth\n" * 500)
            except BlockingIOError:
                pass
            self.assertEqual(self.ctl("status")[0], 0)
            self.assertEqual(ping(self.port).id, 1)

    def test_standard_input(self):
        sim = Sim("--devices", "XM430-W350@57600:7", "--control", "-")
        def say(line):
            sim.process.stdin.write(line.encode() + b"\n")
            sim.process.stdin.flush()
            return sim.process.stdout.readline().decode().strip()
        self.assertEqual(say("fault drop"), "ok")
        port = Port(sim.path)
        self.assertEqual(port.ask(packet(7, PING), 0), [])
        self.assertEqual(say("fault clear"), "ok")
        self.assertEqual(ping(port, 7).id, 7)
        self.assertEqual(json.loads(say("status"))["devices"][0]["id"], 7)
        self.assertTrue(say("nonsense").startswith("error: "))
        self.assertEqual(sim.ctl("status")[0], 0)  # without a link the socket goes by the terminal
        self.assertEqual(say("quit"), "ok")
        self.assertEqual(sim.process.wait(30), 0)
        port.close()
        sim.stop()


def client(what, path):
    """A program of its own that the tests above start and kill."""
    try:
        port = Port(path, exclusive=True)
    except OSError as error:
        print("busy" if error.errno == errno.EBUSY else error, flush=True)
        return
    if what == "--once":
        print("answered" if ping(port) else "silence", flush=True)
        return
    if ping(port):
        print("polling", flush=True)
    while True:
        ping(port)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in ("--once", "--poll-exclusively"):
        client(*sys.argv[1:])
    else:
        unittest.main()
