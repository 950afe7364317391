//! The polynomial of fifth degree between two times at which a function and its derivatives are known, and the bounds that
//! it proves.

/// A time with the value of a function and its first three derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jet {
    pub(crate) time: f64,
    pub(crate) values: [f64; 4],
}

impl Jet {
    pub(crate) fn is_positive(&self) -> bool {
        self.values[0] > 0.0
    }

    pub(crate) fn is_rising(&self) -> bool {
        self.values[1] > 0.0
    }
}

/// Hermite's polynomial `H` that has the value and the first two derivatives of `f` at both ends of a piece of length `h`.
///
/// With a bound `M` on the sixth derivative everywhere in the piece (G. Birkhoff and A. Priver, J. Math. Phys. 46, 440 (1967))
///
/// ```text
/// |f - H| <= M h^6 / 46080,   |f' - H'| <= sqrt(5) M h^5 / 30000,   |f'' - H''| <= M h^4 / 1920
/// ```
///
/// A polynomial lies between the smallest and the largest of its Bernstein coefficients; here these are the coefficients of
/// `H`, `h H'` and `h^2 H''`.
pub(crate) struct Quintic {
    value: [f64; 6],
    /// `h f'` and `h^2 f''` at both ends.
    rates: [f64; 2],
    seconds: [f64; 2],
    /// `M h^6`, and the allowance for rounding.
    remainder: f64,
    rounding: f64,
}

impl Quintic {
    /// The polynomial between two jets, with bounds on the first, second and sixth derivative of the function.
    #[inline]
    pub(crate) fn between(a: &Jet, b: &Jet, [first, second, sixth]: [f64; 3]) -> Self {
        let h = b.time - a.time;
        let square = h * h;
        let ([f, df, ddf, _], [g, dg, ddg, _]) = (a.values, b.values);
        let (df, dg, ddf, ddg) = (df * h, dg * h, ddf * square, ddg * square);
        let (c1, c2) = (f + df / 5.0, f + df * 0.4 + ddf / 20.0);
        let (c4, c3) = (g - dg / 5.0, g - dg * 0.4 + ddg / 20.0);
        Self {
            value: [f, c1, c2, c3, c4, g],
            rates: [df, dg],
            seconds: [ddf, ddg],
            remainder: sixth * square * square * square,
            rounding: 8.0 * f64::EPSILON * (1.0 + h * first + square * second),
        }
    }

    #[inline]
    fn rate(&self) -> [f64; 5] {
        let ([df, dg], [ddf, ddg]) = (self.rates, self.seconds);
        [df, df + ddf / 4.0, 5.0 * (self.value[3] - self.value[2]), dg - ddg / 4.0, dg]
    }

    /// Whether the function keeps one sign and stays farther from zero than `distance`.
    #[inline]
    pub(crate) fn is_clear(&self, distance: f64) -> bool {
        one_sign(&self.value, self.remainder / 46080.0 + self.rounding + distance).is_some()
    }

    /// Whether the function is monotonic over the whole piece.
    #[inline]
    pub(crate) fn is_monotonic(&self) -> bool {
        // Each coefficient is a difference of two values, times five.
        one_sign(&self.rate(), self.remainder * 7.46e-5 + 10.0 * self.rounding).is_some()
    }

    /// Whether its graph is convex (`Some(true)`) or concave over the whole piece.
    #[inline]
    pub(crate) fn convexity(&self) -> Option<bool> {
        let ([ddf, ddg], [_, r1, r2, r3, _]) = (self.seconds, self.rate());
        one_sign(&[ddf, 4.0 * (r2 - r1), 4.0 * (r3 - r2), ddg], self.remainder / 1920.0 + 80.0 * self.rounding)
    }

    /// The zero crossing of the polynomial, as a fraction of the piece; the signs at its ends differ. It is approximate.
    #[inline]
    pub(crate) fn root(&self) -> f64 {
        let [c0, c1, c2, c3, c4, c5] = self.value;
        // Powers of the fraction.
        let [p1, p2] = [5.0 * (c1 - c0), 10.0 * (c0 - 2.0 * c1 + c2)];
        let p3 = 10.0 * (c3 - c0 + 3.0 * (c1 - c2));
        let p4 = 5.0 * (c0 + c4 - 4.0 * (c1 + c3) + 6.0 * c2);
        let p5 = c5 - c0 + 5.0 * (c1 - c4) + 10.0 * (c3 - c2);
        let (mut low, mut high, mut x) = (0.0, 1.0, c0 / (c0 - c5));
        for _ in 0..8 {
            let value = c0 + x * (p1 + x * (p2 + x * (p3 + x * (p4 + x * p5))));
            let rate = p1 + x * (2.0 * p2 + x * (3.0 * p3 + x * (4.0 * p4 + x * (5.0 * p5))));
            let half_second = p2 + x * (3.0 * p3 + x * (6.0 * p4 + x * (10.0 * p5)));
            if (value > 0.0) == (c5 > 0.0) {
                high = x;
            } else {
                low = x;
            }
            // Halley's step.
            let step = value * rate / (rate * rate - value * half_second);
            let next = x - step;
            if !(low < next && next < high) {
                x = low + (high - low) / 2.0;
                continue;
            }
            x = next;
            if step.abs() < 3e-2 {
                break;
            }
        }
        x
    }
}

/// The common sign of numbers that are all farther from zero than `error`.
#[inline]
fn one_sign(values: &[f64], error: f64) -> Option<bool> {
    let (mut least, mut most) = (values[0], values[0]);
    for &value in &values[1..] {
        least = if value < least { value } else { least };
        most = if value > most { value } else { most };
    }
    if least > error {
        Some(true)
    } else if most < -error {
        Some(false)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;

    const BOUNDS: [f64; 3] = [1.0; 3];
    const DISTANCE: f64 = 2e-13;

    /// `sin t + offset`, whose derivatives are bounded by one.
    fn sine(time: f64, offset: f64) -> Jet {
        let (sin, cos) = time.sin_cos();
        Jet { time, values: [sin + offset, cos, -sin, -cos] }
    }

    #[test]
    fn nothing_is_proved_that_is_wrong_and_most_of_what_is_right() {
        let (mut proved, mut pieces) = (0, 0);
        for i in 0..400 {
            for offset in [-0.999, -0.7, -0.3, 0.0, 0.2, 0.95, 1.02] {
                let (from, length) = (0.031 * f64::from(i), 0.2 + 1.7 * f64::from(i % 17) / 17.0);
                let polynomial = Quintic::between(&sine(from, offset), &sine(from + length, offset), BOUNDS);
                let points: Vec<_> = (0..=200).map(|k| sine(from + length * f64::from(k) / 200.0, offset)).collect();
                let one_sign = |k: usize| {
                    let positive = points.iter().filter(|jet| jet.values[k] > 0.0).count();
                    positive == 0 || positive == points.len()
                };
                let claims =
                    [polynomial.is_clear(DISTANCE), polynomial.is_monotonic(), polynomial.convexity().is_some()];
                for (k, claim) in claims.into_iter().enumerate() {
                    assert!(!claim || one_sign(k), "derivative {k} from {from} over {length}, offset {offset}");
                    pieces += usize::from(one_sign(k));
                    proved += usize::from(claim);
                }
            }
        }
        assert!(10 * proved > 8 * pieces, "{proved} of {pieces}");
    }

    /// `f = (t (t - h))^3 / 720` has the sixth derivative one and vanishes with two derivatives at both ends, so that `H = 0`. The
    /// largest values of `-f`, `|f'|` and `|f''|` are the three bounds.
    #[test]
    fn remainder_is_neither_less_nor_much_more_than_it_can_be() {
        let h: f64 = 1.5;
        let between = |[value, rate, second]: [f64; 3]| {
            let jet = |time: f64| {
                let values = [value + time * (rate + time * second / 2.0), rate + time * second, second, 0.0];
                Jet { time, values }
            };
            Quintic::between(&jet(0.0), &jet(h), BOUNDS)
        };
        let (dip, slope, bend) = (h.powi(6) / 46080.0, h.powi(5) * 5_f64.sqrt() / 30000.0, h.powi(4) / 1920.0);
        assert!(
            !between([0.99 * dip, 0.0, 0.0]).is_clear(DISTANCE) && between([1.01 * dip, 0.0, 0.0]).is_clear(DISTANCE)
        );
        assert!(!between([0.0, 0.99 * slope, 0.0]).is_monotonic() && between([0.0, 1.01 * slope, 0.0]).is_monotonic());
        assert!(between([0.0, 0.0, 0.99 * bend]).convexity().is_none());
        assert_eq!(between([0.0, 0.0, 1.01 * bend]).convexity(), Some(true));
    }

    /// The polynomials have any shape, many of them three or five roots.
    #[test]
    fn the_root_is_close_to_one_of_the_polynomial() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut far = 0;
        for _ in 0..20_000 {
            let mut value: [f64; 6] = core::array::from_fn(|_| random.random_range(-1.0..1.0));
            (value[0], value[5]) = (-value[0].abs(), value[5].abs());
            let quintic = Quintic { value, rates: [0.0; 2], seconds: [0.0; 2], remainder: 0.0, rounding: 0.0 };
            let x = quintic.root();
            assert!((0.0..=1.0).contains(&x));
            let at = |x: f64| {
                let mut row = value;
                for last in (0..5).rev() {
                    for k in 0..=last {
                        row[k] += x * (row[k + 1] - row[k]);
                    }
                }
                row[0]
            };
            // There is a change of sign within three hundredths.
            let around = (at((x - 0.03).max(0.0)), at((x + 0.03).min(1.0)));
            far += usize::from(around.0 * around.1 > 0.0);
        }
        // Where it is flat, or has two more roots nearby.
        assert!(far <= 880, "{far} of 20000");
    }
}
