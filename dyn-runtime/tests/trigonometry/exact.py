"""The numbers behind `src/trigonometry.rs`, by mpmath with 60 digits: needs `pip install mpmath`.

    python exact.py > exact.txt     sines and cosines that the tests compare with
    python exact.py --numbers       parts of pi/2, and polynomials of least relative error (Remez' exchange)

A line of `exact.txt` is an angle in `f64`, its sine and its cosine, each as a number in `f64` and what is missing then.
"""

import random
import struct
import sys

from mpmath import cos, log, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 60


def angles():
    """Ordinary ones, near multiples of pi/2 (also those that single precision can hold), small, large."""
    generator = random.Random(1)
    yield from (0.0, 5e-324, 2.2e-308, 1e-160, 1e-20, 1e-8, 1.4901161e-8, 2.0**-13, 0.5, 1.0, 2.0, 3.0)
    for _ in range(200):
        yield generator.uniform(0, 1) * 10 ** generator.uniform(-9, 3.5)
    for n in list(range(1, 30)) + [generator.randrange(60, 2037) for _ in range(40)]:
        multiple = n * pi / 2
        for number in (float(multiple), single(multiple), float(multiple - pi / 4)):
            yield number
            yield following(number)
    yield from hardest(100, 11, float)
    yield from hardest(50, 9, single)
    yield from (3199.9999, 3200.0, 3200.0001, 800.00006, 1e5, 1e10, 1e22, 1.7976931348623157e308)


def hardest(count, bits, rounded):
    """Of the numbers that `rounded` gives, the nearest to n pi/2, n of so many bits."""
    multiples = [n * pi / 2 for n in range(1, 2**bits)]
    return sorted((rounded(x) for x in multiples), key=lambda x: abs(sin(2 * mpf(x))))[:count]


def single(x):
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def following(x):
    return struct.unpack("d", struct.pack("q", struct.unpack("q", struct.pack("d", x))[0] + 1))[0]


def table():
    for x in angles():
        numbers = [x]
        for exact in (sin(mpf(x)), cos(mpf(x))):
            numbers += [float(exact), float(exact - mpf(float(exact)))]
        print(*map(repr, numbers))


def parts(bits):
    """pi/2 as numbers of so many bits each, and the rest."""
    rest, found = pi / 2, []
    for width in bits:
        scale = mpf(2) ** (width - mp.floor(log(rest, 2)) - 1)
        found.append(mp.floor(rest * scale) / scale)
        rest -= found[-1]
    return [*found, rest]


def polynomial(function, weight, terms):
    """Coefficients that keep |weight (p - function)| least up to (pi/4)^2, and that error."""
    least, largest = mpf("1e-12"), (pi / 4 * mpf("1.0001")) ** 2
    points = [
        (least + largest) / 2 - (largest - least) / 2 * cos(pi * (2 * k + 1) / (2 * terms + 2))
        for k in range(terms + 1)
    ]
    grid = [least + (largest - least) * k / 2000 for k in range(2001)]
    for _ in range(12):
        system, right = matrix(terms + 1, terms + 1), matrix(terms + 1, 1)
        for i, z in enumerate(points):
            for j in range(terms):
                system[i, j] = z**j
            system[i, terms] = (-1) ** i / weight(z)
            right[i] = function(z)
        solution = lu_solve(system, right)
        coefficients = [solution[j] for j in range(terms)]

        def error(z):
            return weight(z) * (sum(c * z**j for j, c in enumerate(coefficients)) - function(z))

        # The largest error of each sign, from one end to the other.
        peaks = []
        for z, e in ((z, error(z)) for z in grid):
            if not peaks or (e > 0) != (peaks[-1][1] > 0):
                peaks.append((z, e))
            elif abs(e) > abs(peaks[-1][1]):
                peaks[-1] = (z, e)
        points = [z for z, _ in peaks]
    return coefficients, abs(solution[terms])


def numbers():
    for bits in ([42, 42], [15, 15, 15]):
        print("pi/2:", *[repr(float(part)) for part in parts(bits)])
    of_sine = (lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z * sqrt(z) / sin(sqrt(z)))
    of_cosine = (lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2 / cos(sqrt(z)))
    for terms in (6, 4):
        for name, (function, weight) in (("sine", of_sine), ("cosine", of_cosine)):
            coefficients, error = polynomial(function, weight, terms)
            print(f"{name}, relative error 2^{nstr(log(error, 2), 4)}:", *[repr(float(c)) for c in coefficients])


if __name__ == "__main__":
    numbers() if "--numbers" in sys.argv else table()
