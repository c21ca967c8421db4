# SPDX-License-Identifier: GPL-3.0-only
"""Systems that lack something: a filter (seccomp) lets system calls of a program under test fail. Numbers are those of x86_64."""

import ctypes
import errno
import platform
import struct

LANDLOCK_CREATE_RULESET, PRCTL, FLOCK = 444, 157, 73
PR_SET_SECCOMP, PR_SET_NO_NEW_PRIVS = 22, 38
CAN_FILTER = platform.machine() == "x86_64"

LOAD, EQUAL, ANSWER = 0x20, 0x15, 0x06
REFUSED, ALLOWED = 0x00050000, 0x7FFF0000
ARGUMENT = 16  # the place of the first


def refuse(*calls):
    """For preexec_fn: each call, (number, first argument or None, error), fails from now on."""
    rows = []
    for number, argument, error in calls:
        answer = [(ANSWER, 0, 0, REFUSED | error)]
        if argument is not None:
            answer = [(LOAD, 0, 0, ARGUMENT), (EQUAL, 0, 1, argument), *answer]
        rows += [(LOAD, 0, 0, 0), (EQUAL, 0, len(answer), number), *answer]
    rows.append((ANSWER, 0, 0, ALLOWED))
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *row) for row in rows))
    program = ctypes.create_string_buffer(struct.pack("HxxxxxxP", len(rows), ctypes.addressof(code)))
    prctl = ctypes.CDLL(None, use_errno=True).prctl

    def install():
        assert code  # is kept as long as the program names it
        if prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 or prctl(PR_SET_SECCOMP, 2, program, 0, 0) != 0:
            raise OSError(ctypes.get_errno(), "no filter")

    return install


def without_landlock():
    return refuse((LANDLOCK_CREATE_RULESET, None, errno.ENOSYS))


def without_confinement():
    return refuse((LANDLOCK_CREATE_RULESET, None, errno.ENOSYS), (PRCTL, PR_SET_SECCOMP, errno.EINVAL))


def without_locks(error=errno.ENOLCK):
    return refuse((FLOCK, None, error))
