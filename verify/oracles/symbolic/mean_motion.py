"""The motion averaged over the fast rotation of n about L, to second order in s (docs/averaged-solution.md).

n turns about l = L / G at the rate G / I^xx at constant c = n.l: n = c l + sqrt(1 - c^2) (cos p e_1 + sin p e_2). A function F moves n by
F_L x n and L by F_L x L + F_n x n, so that a function g changes at the rate -{F, g} with {f, g} = L.(f_L x g_L) + n.(f_L x g_n + f_n x g_L).
With {T, W} = -(V - <V>) the flow of W takes T + V to T + <V> + {V + <V>, W} / 2 + third order; its average is the mean Hamiltonian.
"""

from sympy import Matrix, cos, diff, expand, integrate, pi, sin, solve, sqrt, symbols

from coordinates import c as strength
from coordinates import i_xx, symmetric
from lagrangian import L, N

p, theta = symbols("p theta")
size = symbols("size", positive=True)
S = symmetric("S")
TRACELESS = {S[2, 2]: -S[0, 0] - S[1, 1]}


def potential(n, s):
    """The anisotropic energy of an axis."""
    return strength * (n.T * s * n)[0]


def in_fast_frame(expression):
    """n and L in axes with l along the third one."""
    values = dict(zip(N, [sin(theta) * cos(p), sin(theta) * sin(p), cos(theta)])) | dict(zip(L, [0, 0, size]))
    return expression.subs(values)


def average(expression):
    """The average over the fast angle."""
    return integrate(expand(expression), (p, 0, 2 * pi)) / (2 * pi)


def invariants(n, momentum):
    """c, h = l.(s l) as functions of n and L, for gradients."""
    g = sqrt(momentum.dot(momentum))
    return n.dot(momentum) / g, (momentum.T * S * momentum)[0] / g**2


def first_order():
    """<V> in the fast frame, and the coefficients (u, v) of <V> = C (u(c) h + v(c) tr s)."""
    mean = average(in_fast_frame(potential(N, S)))
    # In the fast frame h = s^33.
    by_h = diff(mean, S[2, 2]) - diff(mean, S[0, 0])
    by_trace = diff(mean, S[0, 0])
    assert expand(mean - by_h * S[2, 2] - by_trace * S.trace()) == 0
    return mean, (by_h / strength).simplify(), (by_trace / strength).simplify()


MEAN_1, BY_H, BY_TRACE = first_order()


def mean_potential_of_vectors():
    """C (u h + v tr s) as a function of n and L; u and v are polynomials in c = cos(theta), found from their values."""
    c_symbol = symbols("c_symbol")
    c, h = invariants(N, L)
    u = expand(BY_H.rewrite(cos).subs(sin(theta) ** 2, 1 - cos(theta) ** 2)).subs(cos(theta), c_symbol)
    v = expand(BY_TRACE.rewrite(cos).subs(sin(theta) ** 2, 1 - cos(theta) ** 2)).subs(cos(theta), c_symbol)
    return strength * (polynomial_in_c(u, c_symbol).subs(c_symbol, c) * h + polynomial_in_c(v, c_symbol).subs(c_symbol, c) * S.trace())


def polynomial_in_c(expression, c_symbol):
    """A function of theta as the polynomial x_0 + x_1 c^2."""
    x = symbols("x_0:2")
    difference = expression.subs(c_symbol, cos(theta)) - x[0] - x[1] * cos(theta) ** 2
    found = solve([difference.subs(theta, value) for value in (pi / 2, pi / 3)], x, dict=True)[0]
    assert difference.subs(found).simplify() == 0
    return found[x[0]] + found[x[1]] * c_symbol**2


MEAN_1_OF_VECTORS = mean_potential_of_vectors()


def generator():
    """W = (I / G) int (V - <V>) dp without mean, and the same in vector form, (x_1 c l + x_2 n).s (l x n) C I / G."""
    integral = integrate(expand(in_fast_frame(potential(N, S)) - MEAN_1), p)
    direct = i_xx / size * (integral - average(integral))
    g = sqrt(L.dot(L))
    x_1, x_2 = symbols("x_1 x_2")
    l = L / g
    covariant = strength * i_xx / g * ((x_1 * N.dot(l) * l + x_2 * N).T * S * l.cross(N))[0]
    difference = expand(in_fast_frame(covariant) - direct)
    equations = [difference.subs({p: a, theta: b}) for a, b in ((pi / 3, pi / 4), (pi / 4, pi / 3), (pi / 6, pi / 6))]
    equations = [e.subs({S[0, 1]: u, S[0, 2]: v, S[1, 2]: w}) for e in equations for u, v, w in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    equations = [e.subs({S[0, 0]: 0, S[1, 1]: 0, S[2, 2]: 0}) for e in equations]
    found = solve(equations, [x_1, x_2], dict=True)[0]
    assert difference.subs(found).simplify() == 0
    return covariant.subs(found)


GENERATOR = generator()


def bracket(f, g):
    """{f, g} of functions of n and L."""
    gradient = lambda function, variables: Matrix([diff(function, v) for v in variables])
    f_n, f_l, g_n, g_l = gradient(f, N), gradient(f, L), gradient(g, N), gradient(g, L)
    return L.dot(f_l.cross(g_l)) + N.dot(f_l.cross(g_n) + f_n.cross(g_l))


def second_order():
    """a_1, a_2, a_3 of <H>_2 = (C^2 I / G^2) (a_1 h^2 + a_2 |s l|^2 + a_3 tr s^2) for traceless s, functions of theta."""
    pulled = bracket(potential(N, S) + MEAN_1_OF_VECTORS, GENERATOR) / 2
    mean = average(in_fast_frame(pulled)).subs(TRACELESS)
    mean = expand(mean * size**2 / (strength**2 * i_xx))
    s = S.subs(TRACELESS)
    x = symbols("x_1:4")
    form = x[0] * s[2, 2] ** 2 + x[1] * sum(s[k, 2] ** 2 for k in range(3)) + x[2] * (s * s).trace()
    polynomial = expand(mean - form).as_poly(*[S[i, j] for i, j in ((0, 0), (1, 1), (0, 1), (0, 2), (1, 2))])
    found = solve([coefficient for _, coefficient in polynomial.terms()], x, dict=True)
    assert len(found) == 1, found
    return [found[0][a].simplify() for a in x]


SECOND = second_order()
