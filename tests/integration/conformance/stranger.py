# SPDX-License-Identifier: GPL-3.0-or-later
"""A program that knows nothing of Dynascope: DYNAMIXEL packets and a serial terminal in a few lines of its own."""
import fcntl
import os
import select
import struct
import subprocess
import termios
import time

PING, READ, WRITE, REG_WRITE, ACTION, FACTORY_RESET, REBOOT = 1, 2, 3, 4, 5, 6, 8
CLEAR, BACKUP, STATUS = 0x10, 0x20, 0x55
SYNC_READ, SYNC_WRITE, FAST_SYNC_READ = 0x82, 0x83, 0x8A
BULK_READ, BULK_WRITE, FAST_BULK_READ = 0x92, 0x93, 0x9A
BROADCAST = 0xFE

TCGETS2, TCSETS2, BOTHER = 0x802C542A, 0x402C542B, 0o010000


def crc(data):
    value = 0
    for byte in data:
        value ^= byte << 8
        for _ in range(8):
            value = ((value << 1) ^ 0x8005 if value & 0x8000 else value << 1) & 0xFFFF
    return value


def stuff(body):
    out, run = bytearray(), bytearray()
    for byte in body:
        out.append(byte)
        run.append(byte)
        if run[-3:] == b"\xff\xff\xfd":
            out.append(0xFD)
            run.clear()
    return bytes(out)


def unstuff(body):
    out, at = bytearray(), 0
    run = bytearray()
    while at < len(body):
        out.append(body[at])
        run.append(body[at])
        at += 1
        if run[-3:] == b"\xff\xff\xfd":
            at += 1
            run.clear()
    return bytes(out)


def packet(device, instruction, *parameters):
    body = stuff(bytes([instruction]) + b"".join(parameters))
    head = b"\xff\xff\xfd\x00" + bytes([device]) + struct.pack("<H", len(body) + 2)
    return head + body + struct.pack("<H", crc(head + body))


def u8(*values):
    return bytes(values)


def u16(*values):
    return struct.pack("<%dH" % len(values), *values)


def u32(*values):
    return struct.pack("<%dI" % len(values), *(value & 0xFFFFFFFF for value in values))


class Status:
    def __init__(self, device, error, data):
        self.id, self.error, self.data = device, error & 0x7F, data
        self.alert = bool(error & 0x80)

    def __eq__(self, other):
        return (self.id, self.error, self.data) == (other.id, other.error, other.data)

    def __repr__(self):
        return "Status(id=%d, error=%d, data=%s)" % (self.id, self.error, self.data.hex(" "))


def split(data):
    """Whole valid status packets, and what is left over."""
    found = []
    while len(data) >= 7 and data[:4] == b"\xff\xff\xfd\x00":
        size = 7 + struct.unpack_from("<H", data, 5)[0]
        if len(data) < size or crc(data[:size - 2]) != struct.unpack_from("<H", data, size - 2)[0]:
            break
        body = unstuff(data[7:size - 2])
        if body[0] != STATUS:
            break
        found.append(Status(data[4], body[1], body[2:]))
        data = data[size:]
    return found, data


class Port:
    """Opened as programs open /dev/ttyUSB0."""

    def __init__(self, path, baud=57600, exclusive=False):
        self.fd = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.set_baud(baud)
        if exclusive:
            fcntl.ioctl(self.fd, termios.TIOCEXCL)

    def set_baud(self, baud):
        self.baud = baud
        standard = getattr(termios, "B%d" % baud, None)
        if standard is not None:
            attributes = termios.tcgetattr(self.fd)
            attributes[0] = attributes[1] = attributes[3] = 0
            attributes[2] = termios.CS8 | termios.CREAD | termios.CLOCAL
            attributes[4] = attributes[5] = standard
            termios.tcsetattr(self.fd, termios.TCSANOW, attributes)
            return
        settings = bytearray(fcntl.ioctl(self.fd, TCGETS2, bytes(44)))
        flags = list(struct.unpack_from("<4I", settings))
        flags[0] = flags[1] = flags[3] = 0
        flags[2] = termios.CS8 | termios.CREAD | termios.CLOCAL | BOTHER
        struct.pack_into("<4I", settings, 0, *flags)
        struct.pack_into("<2I", settings, 36, baud, baud)
        fcntl.ioctl(self.fd, TCSETS2, bytes(settings))

    def close(self):
        os.close(self.fd)

    def send(self, data):
        while data:
            data = data[os.write(self.fd, data):]

    def receive(self, enough, patience=3.0, quiet=0.15):
        """What comes, until `enough(data)`, or nothing came for so long: `patience` before the first byte, `quiet` after."""
        data = b""
        while not (data and enough(data)):
            if not select.select([self.fd], [], [], quiet if data else patience)[0]:
                break
            try:
                piece = os.read(self.fd, 4096)
            except OSError:
                break
            if not piece:
                break
            data += piece
        return data

    def ask(self, request, answers, patience=3.0):
        """`answers` status packets; 0: silence is expected, and waited for briefly."""
        self.send(request)
        if answers == 0:
            return split(self.receive(lambda data: False, patience=0.12))[0]
        return split(self.receive(lambda data: len(split(data)[0]) >= answers, patience))[0]

    def one(self, request):
        answers = self.ask(request, 1)
        return answers[0] if answers else None

    def read(self, device, address, size):
        answer = self.one(packet(device, READ, u16(address, size)))
        return int.from_bytes(answer.data, "little") if answer and not answer.error else None

    def write(self, device, address, data):
        return self.one(packet(device, WRITE, u16(address), data))


class Sim:
    """`dxl sim`, started as a user starts it."""
    program = os.environ.get("DXL", "dxl")

    def __init__(self, *arguments, wrapper=()):
        self.process = subprocess.Popen([*wrapper, self.program, "sim", *arguments], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.path = self.process.stdout.readline().decode().strip()
        if not self.path:
            why = self.process.stderr.read().decode()
            self.stop()
            raise RuntimeError(why)

    def ctl(self, *words):
        done = subprocess.run([self.program, "sim", "ctl", self.path, *words], capture_output=True, timeout=30)
        return done.returncode, done.stdout.decode().strip(), done.stderr.decode().strip()

    def stop(self):
        self.process.terminate()
        self.process.wait(30)
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            stream.close()
        return self.process.returncode


def until(condition, seconds=5.0):
    """Waits for a condition, not for time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.01)
    return bool(condition())
