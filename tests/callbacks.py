"""The compiled callbacks of a system as functions of Python, and the differences their derivatives must agree with."""

import ctypes

import numpy as np

from fairlead.system.compiled.system import Instance


class Called:
    """The callbacks of a system, matrices dense."""

    def __init__(self, system):
        self.system, self.n = system if isinstance(system, Instance) else system.instance(), system.n

    def _call(self, name, *arguments):
        kinds = [ctypes.c_double if isinstance(a, float) else ctypes.c_void_p for a in arguments]
        pointers = [a if isinstance(a, float) else a.ctypes.data for a in arguments]
        ctypes.CFUNCTYPE(None, ctypes.c_void_p, *kinds)(self.system.callbacks[name])(self.system.context, *pointers)

    def rhs(self, t, y):
        f = np.zeros(self.n)
        self._call("rhs", t, y, f)
        return f

    def jacobian(self, t, y):
        values, ft = np.zeros(len(self.system.pattern.rows)), np.zeros(self.n)
        self._call("jacobian", t, y, values, ft)
        return self._dense(self.system.pattern, values), ft

    def mass(self):
        values = np.zeros(len(self.system.mass_pattern.rows))
        self._call("mass", values)
        return self._dense(self.system.mass_pattern, values)

    def _dense(self, pattern, values):
        columns = np.repeat(np.arange(self.n), np.diff(pattern.starts))
        full = np.zeros((self.n, self.n))
        np.add.at(full, (pattern.rows, columns), values)
        return full


def differences(function, y, steps):
    """Central differences of a vector function, one column a component of y."""
    columns = []
    for k, h in enumerate(steps):
        up, down = y.copy(), y.copy()
        up[k], down[k] = y[k] + h, y[k] - h
        columns.append((function(up) - function(down)) / (up[k] - down[k]))
    return np.array(columns).T
