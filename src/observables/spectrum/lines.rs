//! The spectral lines of a function of the state.

use core::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::transform::{coefficients, multiples, points};
use super::{Combination, QuasiPeriodicMotion};
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;

/// Points of the first grid in each angle.
const FIRST_GRID: [usize; 3] = [8, 8, 4];

/// Largest number of points of a grid, which takes some tenths of a second.
const MOST_POINTS: usize = 1 << 18;

/// Amplitudes at the edge of the grid must be below this fraction of the least amplitude.
const EDGE: f64 = 0.1;

/// Amplitudes at the edge are noise if they are below this fraction of the size of the function, and if doubling the points in the angle has twice left more
/// than [`UNCHANGED`] of them.
const LARGEST_NOISE: f64 = 2e-10;
const UNCHANGED: f64 = 0.7;

/// Number of points off the grid at which the sum of the lines is compared with the function.
const PLACES: usize = 16;

/// Listed lines exceed this multiple of the largest amplitude of noise and of the error of the states.
const ABOVE_NOISE: f64 = 4.0;

/// One line `amplitude cos(frequency t + phase)`.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralLine {
    /// Angular frequency, above zero (rad per unit of time).
    pub frequency: f64,
    /// Amplitude, above zero.
    pub amplitude: f64,
    /// Phase at `t = 0`, from -pi to pi (rad).
    pub phase: f64,
    /// Estimated error of the frequency.
    pub uncertainty: f64,
    /// The line as an integer combination of fundamental frequencies.
    pub combination: Combination,
}

impl SpectralLine {
    /// Contribution of the line to the function at the time `t` since the start.
    pub fn value(&self, t: f64) -> f64 {
        self.amplitude * (self.frequency * t + self.phase).cos()
    }
}

/// A constant and the lines of a function, strongest first.
#[derive(Debug, Clone, PartialEq)]
pub struct LineList {
    /// The constant term.
    pub constant: f64,
    /// The lines.
    pub lines: Vec<SpectralLine>,
    /// Smallest amplitude that is listed: the requested value, or the rounding of a constant. Amplitudes are accurate to a tenth of it.
    pub least: f64,
    /// Largest residual of the sum of listed parts at sixteen points of the torus, that is, the size of the parts that are not listed. Terms of zero
    /// frequency are evaluated at the same points.
    pub left: f64,
}

impl QuasiPeriodicMotion {
    /// The lines of a function of the state, down to the fraction `least` of the strongest one. The function returns its value and the size of
    /// the vector or quantity of which the value is a component, such as `|L|` for a component of `L`; rounding is measured relative to this
    /// size.
    ///
    /// The function is sampled on a grid of the torus, which is refined by two in an angle until the amplitudes at the edge of the grid are below
    /// the least amplitude or below noise; an angle on which the function does not depend has one point. Lines that are left out are below
    /// [`LineList::least`].
    ///
    /// # Errors
    /// The errors of the function; [`Error::Domain`] for a function whose series converges so slowly that a quarter of a million points are not
    /// enough, for example one that jumps.
    pub fn lines<E: From<Error>>(
        &self,
        least: f64,
        function: impl Fn(&BodyState<f64>) -> Result<[f64; 2], E>,
    ) -> Result<LineList, E> {
        let at = |turns: [f64; 3]| function(&self.state_after_turns(turns));
        let still = self.still(&at)?;
        let mut counts: [usize; 3] = core::array::from_fn(|i| if still[i] { 1 } else { FIRST_GRID[i] });
        // For each angle, how often in a row doubling its points has left the amplitudes at the edge unchanged, and the largest of them.
        let mut before = [(0, f64::INFINITY); 3];
        loop {
            let (mut values, mut size) = (Vec::with_capacity(counts.iter().product()), 0.0_f64);
            for turns in points(counts) {
                let [value, of] = at(turns)?;
                values.push(value);
                size = size.max(of);
            }
            let all = coefficients(&values, counts);
            let (strongest, edges) = strongest_and_edges(&all, counts);
            let wanted = (least * strongest).max(ABOVE_NOISE * self.error() * size);
            let is_noise = |i: usize| before[i].0 >= 2 && edges[i] < LARGEST_NOISE * size;
            let next = (0..3).filter(|&i| counts[i] > 1 && edges[i] > EDGE * wanted && !is_noise(i));
            let Some(angle) = next.max_by(|&i, &j| edges[i].total_cmp(&edges[j])) else {
                let noise = (0..3).filter(|&i| is_noise(i)).map(|i| ABOVE_NOISE * edges[i]).fold(0.0, f64::max);
                return self.listed(&all, counts, wanted.max(noise).max(f64::MIN_POSITIVE), &at);
            };
            let (times, last) = before[angle];
            before[angle] = (if edges[angle] > UNCHANGED * last { times + 1 } else { 0 }, edges[angle]);
            counts[angle] *= 2;
            Error::ensure(
                counts.iter().product::<usize>() <= MOST_POINTS,
                "largest amplitude at the edge of a grid of a quarter of a million points of the torus, relative to the strongest line",
                edges[angle] / strongest,
                "at most a tenth of the least amplitude; the lines of this function fall off slowly, as for a function with a jump",
            )?;
        }
    }

    /// The angles on which a function does not depend, or that do not move: its values are identical wherever these angles are.
    fn still<E>(&self, at: &impl Fn([f64; 3]) -> Result<[f64; 2], E>) -> Result<[bool; 3], E> {
        const PLACE: [f64; 3] = [0.127, 0.411, 0.283];
        let first = at(PLACE)?;
        let mut still = [true; 3];
        for (i, still) in still.iter_mut().enumerate() {
            if self.rates()[i] == 0.0 {
                continue;
            }
            for part in [0.19, 0.37, 0.71] {
                let mut turns = PLACE;
                turns[i] += part;
                *still &= at(turns)?[0] == first[0];
            }
        }
        Ok(still)
    }

    /// The terms by frequency. Terms of one frequency are a single one: their sum, with the multiples of the largest.
    fn by_frequency(&self, terms: &[Term]) -> Vec<Term> {
        let mut sorted: Vec<_> =
            terms.iter().map(|(multiples, of)| (self.turns(*multiples), *multiples, *of)).collect();
        sorted.sort_by(|(a, ..), (b, ..)| a.high.total_cmp(&b.high).then(a.low.total_cmp(&b.low)));
        let is_one = |a: &[i32; 3], b: &[i32; 3]| self.turns([0, 1, 2].map(|i| a[i] - b[i])).high == 0.0;
        let group = |group: &[(DoubleDouble, [i32; 3], Complex<f64>)]| {
            let largest = group.iter().max_by(|a, b| a.2.norm().total_cmp(&b.2.norm())).expect("a term");
            (largest.1, group.iter().map(|(.., coefficient)| coefficient).sum())
        };
        sorted.chunk_by(|(_, a, _), (_, b, _)| is_one(a, b)).map(group).collect()
    }

    fn listed<E>(
        &self,
        all: &[Complex<f64>],
        counts: [usize; 3],
        least: f64,
        at: &impl Fn([f64; 3]) -> Result<[f64; 2], E>,
    ) -> Result<LineList, E> {
        let listed = |(place, coefficient): (usize, &Complex<f64>)| {
            (2.0 * coefficient.norm() >= least).then(|| (multiples(place, counts), *coefficient))
        };
        let terms: Vec<_> = all.iter().enumerate().skip(1).filter_map(listed).collect();
        let (mut lines, mut constant) = (Vec::new(), all[0].re);
        for (multiples, coefficient) in self.by_frequency(&terms) {
            let [frequency, uncertainty] = self.frequency(multiples);
            let (amplitude, phase) = (2.0 * coefficient.norm(), coefficient.arg());
            if frequency == 0.0 {
                constant += coefficient.re;
            } else if frequency > 0.0 && amplitude >= least {
                // The others have the opposite multiples.
                let combination = self.frequencies().combination(multiples);
                lines.push(SpectralLine { frequency, amplitude, phase, uncertainty, combination });
            }
        }
        let mut left = 0.0_f64;
        for k in 0..PLACES {
            // Turns that are not fractions of the grid, from the first prime numbers.
            let turns = [2.0_f64, 3.0, 5.0].map(|prime| (k as f64 + 0.5) * prime.sqrt());
            let turns: [f64; 3] = core::array::from_fn(|i| if counts[i] > 1 { turns[i].fract() } else { 0.0 });
            let here = |(multiples, coefficient): &Term| {
                let angle: f64 = (0..3).map(|i| f64::from(multiples[i]) * turns[i]).sum();
                (coefficient * Complex::cis(TAU * angle)).re
            };
            left = left.max((at(turns)?[0] - all[0].re - terms.iter().map(here).sum::<f64>()).abs());
        }
        lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        Ok(LineList { constant, lines, least, left })
    }
}

/// A term of the series: multiples of the angles, and their coefficient.
type Term = ([i32; 3], Complex<f64>);

/// Largest amplitude of a line, twice the size of its coefficient, and for each angle the largest among multiples in the upper quarter of the
/// grid.
fn strongest_and_edges(all: &[Complex<f64>], counts: [usize; 3]) -> (f64, [f64; 3]) {
    let (mut strongest, mut edges) = (0.0_f64, [0.0_f64; 3]);
    for (place, amplitude) in all.iter().map(|coefficient| 2.0 * coefficient.norm()).enumerate().skip(1) {
        strongest = strongest.max(amplitude);
        let multiples = multiples(place, counts);
        for i in 0..3 {
            if counts[i] > 1 && 8 * multiples[i].unsigned_abs() as usize >= 3 * counts[i] {
                edges[i] = edges[i].max(amplitude);
            }
        }
    }
    (strongest, edges)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::dynamics::fixture::problem;
    use crate::dynamics::{Problem, RigidSpheroid, RotationState};

    fn motion(problem: &Problem<f64>) -> QuasiPeriodicMotion {
        QuasiPeriodicMotion::new(problem).unwrap()
    }

    fn lines(of: &QuasiPeriodicMotion, least: f64, function: impl Fn(&BodyState<f64>) -> f64) -> LineList {
        of.lines(least, |state| Ok::<_, Error>([function(state), 1.0])).unwrap()
    }

    #[test]
    fn lines_are_few_where_few_are_wanted_and_the_same() {
        let found = motion(&problem([0.02, 0.01, -0.03]));
        let of = |least| lines(&found, least, |state| state.equatorial_axis.y);
        let (few, all) = (of(1e-3), of(1e-12));
        assert!(few.lines.len() < all.lines.len() / 3);
        assert!((few.least / few.lines[0].amplitude - 1e-3).abs() < 1e-6 && all.left < 1e-10 && few.left < 0.02);
        for (line, exact) in few.lines.iter().zip(&all.lines) {
            assert_eq!((&line.combination, line.frequency), (&exact.combination, exact.frequency));
            // The aliases from beyond the grid are below the least amplitude.
            assert!((line.amplitude - exact.amplitude).abs() < EDGE * few.least);
        }
        assert!(all.lines.windows(2).all(|pair| pair[0].amplitude >= pair[1].amplitude && pair[1].frequency > 0.0));
    }

    /// A free body whose `n_x` is `3^(1/2) / 2` times the cosine of one angle.
    fn free_precession() -> QuasiPeriodicMotion {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 0.5, constant_c: 0.0 };
        let axis = Vector3::new(0.75_f64.sqrt(), 0.0, 0.5);
        let initial = BodyState { axis, momentum: Vector3::z(), equatorial_axis: Vector3::y() };
        motion(&Problem::new(star, Matrix3::zeros(), initial).unwrap())
    }

    /// The polynomial of Chebyshev, `cos k theta` for `x = cos theta`.
    fn chebyshev(k: f64, x: f64) -> f64 {
        (k * x.clamp(-1.0, 1.0).acos()).cos()
    }

    /// With `x = cos theta` a polynomial of Chebyshev is one line. On eight points the line of `7 theta` adds to that of `theta`: the amplitude of
    /// `3 theta` at the edge of the grid shows that there may be such lines.
    #[test]
    fn amplitudes_are_right_to_a_tenth_of_the_least_one() {
        let found = free_precession();
        for edge in [1.1e-4, 1.5e-4, 1.9e-4] {
            let all = lines(&found, 1e-3, |state| {
                let x = state.axis.x / 0.75_f64.sqrt();
                x + edge * chebyshev(3.0, x) + 1.1e-4 * chebyshev(7.0, x)
            });
            assert!((all.lines[0].amplitude - 1.0).abs() < 1e-4, "{edge:e}: {:?}", all.lines[0]);
        }
    }

    #[test]
    fn frames_do_not_change_lines() {
        let given = problem([0.02, 0.01, -0.03]);
        let turn: Matrix3<f64> = *nalgebra::Rotation3::from_euler_angles(0.3, -1.2, 2.0).matrix();
        let plain = lines(&motion(&given), 1e-9, |state| state.axis.z);
        let turned = lines(&motion(&given.rotated(&turn)), 1e-9, |state| state.rotated(&turn.transpose()).axis.z);
        for (a, b) in plain.lines.iter().zip(&turned.lines).take(10) {
            assert!((a.frequency - b.frequency).abs() < 1e-14 && (a.amplitude - b.amplitude).abs() < 1e-13);
        }
    }

    /// Noise in the last bits of the function ends the refinement of the grid: no line of it is listed, and the lines of the function above it are
    /// unchanged.
    #[test]
    fn noise_is_not_listed() {
        let found = motion(&problem([0.02, 0.01, -0.03]));
        let noise = |value: f64| {
            let mixed = value.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15);
            ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let exact = lines(&found, 1e-14, |state| state.axis.z);
        for part in [1e-11, 1e-10] {
            let with_noise = lines(&found, 1e-14, |state| state.axis.z + part * noise(state.axis.z));
            // Four times the largest amplitude at the edge. An amplitude is twice a coefficient, which is about the size of the noise over the root of
            // twelve times the number of points.
            assert!((8e-3 * part..0.2 * part).contains(&with_noise.least), "{part:e}: {:e}", with_noise.least);
            assert!(with_noise.left < 2.0 * part && exact.left < 1e-12, "{:e}", with_noise.left);
            assert!(with_noise.lines.len() > 10);
            for (line, exact) in with_noise.lines.iter().zip(&exact.lines) {
                assert_eq!(line.combination, exact.combination);
                assert!((line.amplitude - exact.amplitude).abs() < with_noise.least);
            }
            // In another unit too.
            for unit in [1e6, 1e-6] {
                let noisy = |state: &BodyState<f64>| unit * (state.axis.z + part * noise(state.axis.z));
                let same = found.lines(1e-14, |state| Ok::<_, Error>([noisy(state), unit])).unwrap();
                assert_eq!(same.lines.len(), with_noise.lines.len());
                assert!((same.least / unit / with_noise.least - 1.0).abs() < 1e-2, "{:e}", same.least);
            }
        }
        // Noise large enough to be a real signal of the program is not assumed to be noise.
        for unit in [1.0, 1e-6] {
            let noisy = |state: &BodyState<f64>| unit * (state.axis.z + 1e-7 * noise(state.axis.z));
            let loud = found.lines(1e-14, |state| Ok::<_, Error>([noisy(state), unit]));
            assert!(matches!(loud, Err(Error::Domain { .. })), "{loud:?}");
        }
    }

    /// The amplitude at the edge is the same on 8, 16 and 32 points, as that of noise would be, and zero on 64.
    #[test]
    fn lines_of_equal_amplitude_are_not_noise() {
        let found = free_precession();
        let part = 1e-11;
        let all = lines(&found, 1e-12, |state| {
            let x = state.axis.x / 0.75_f64.sqrt();
            x + part * [3.0, 6.0, 14.0].map(|k| chebyshev(k, x)).iter().sum::<f64>()
        });
        assert_eq!(all.lines.len(), 4, "{:?}", all.lines);
        assert!(all.lines[1..].iter().all(|line| (line.amplitude / part - 1.0).abs() < 1e-2), "{:?}", all.lines);
    }

    #[test]
    fn a_constant_has_no_lines_and_a_jump_is_refused() {
        let found = motion(&problem([0.02, 0.01, -0.03]));
        let constant = lines(&found, 1e-6, |state| state.axis.norm_squared());
        assert!(constant.lines.is_empty() && (constant.constant - 1.0).abs() < 1e-14);
        let still = lines(&found, 1e-6, |_| 3.0);
        assert!(still.lines.is_empty() && still.constant == 3.0);
        let jump = found.lines(1e-6, |state| Ok::<_, Error>([state.equatorial_axis.x.signum(), 1.0]));
        assert!(matches!(jump, Err(Error::Domain { .. })));
        let refused = found.lines(1e-6, |_| Err::<[f64; 2], _>(Error::Unsupported { what: "it", why: "no" }));
        assert!(matches!(refused, Err(Error::Unsupported { .. })));
    }

    /// A wobbling star whose `L` is near one axis of `s^IJ` and circles it slowly: a loop of `n` about that axis is shorter than one about `L`.
    #[test]
    fn the_strongest_line_of_the_momentum_is_its_slow_precession() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.1, constant_c: 1.0 };
        for size in [1.0, 1e-3] {
            for wobble in [0.1_f64, 0.4, 1.2] {
                let s = Matrix3::from_diagonal(&(Vector3::new(0.02, 0.01, -0.04) * size));
                let l = Vector3::new(1.0, 0.1, 0.1).normalize();
                let across = l.cross(&Vector3::y()).normalize();
                let axis = l * wobble.cos() + across * wobble.sin();
                let initial = BodyState { axis, momentum: l * 1.1, equatorial_axis: axis.cross(&l).normalize() };
                let found = motion(&Problem::new(star, s, initial).unwrap());
                let of_momentum = lines(&found, 1e-6, |state| state.momentum.y);
                let slow = found.frequencies().rate("l'").expect("L circles X");
                assert_eq!(of_momentum.lines[0].frequency, slow.abs(), "{size} {wobble}: {:?}", of_momentum.lines[0]);
                // To first order l' = (2 C / |L|) P2(c) times the root of the products of differences of eigenvalues.
                let p2 = 1.5 * wobble.cos().powi(2) - 0.5;
                let expected = 2.0 / 1.1 * p2.abs() * size * (0.01_f64 * 0.06).sqrt();
                assert!((slow.abs() / expected - 1.0).abs() < 0.2, "{size} {wobble}: {slow:e} {expected:e}");
            }
        }
    }

    /// Without spin `e_x` does not turn about `n`, and after a start from rest a rate is the difference of two that are equal: terms of one frequency
    /// are one line, and what does not move is in the constant.
    #[test]
    fn a_frequency_is_listed_once() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.1, constant_c: 1.0 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.04));
        let axis = Vector3::new(0.6, 0.24, 0.763_413_6).normalize();
        let across = axis.cross(&Vector3::new(0.3, 0.9, -0.2)).normalize();
        for speed in [0.9, 0.0] {
            let initial = BodyState { axis, momentum: across * speed, equatorial_axis: axis.cross(&across) };
            let problem = Problem::new(star, s, initial).unwrap();
            let found = motion(&problem);
            let value = |state: &BodyState<f64>| state.equatorial_axis.x + 0.7 * state.axis.z;
            let all = lines(&found, 1e-7, value);
            let mut frequencies: Vec<_> = all.lines.iter().map(|line| line.frequency).collect();
            frequencies.sort_by(f64::total_cmp);
            assert!(
                frequencies[0] > 1e-6 && frequencies.windows(2).all(|pair| pair[1] - pair[0] > 1e-10),
                "{speed} {frequencies:?} {:?}",
                found.rates()
            );
            let exact = crate::propagation::PhasedMotion::exact(&problem, 1e4).unwrap();
            for t in [0.0, 17.0, 290.0, 4321.0] {
                let sum = all.constant + all.lines.iter().map(|line| line.value(t)).sum::<f64>();
                assert!((sum - value(&exact.state([t, 0.0]))).abs() < 1e-5, "{speed} {t}: {sum}");
            }
        }
    }

    /// After a start from rest a body may turn about `n`, in either sense: only a rotation about `n` that is rounding is left out.
    #[test]
    fn a_body_without_spin_may_turn() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.2, constant_c: 1.0 };
        let s = Matrix3::from_diagonal(&Vector3::new(0.04, 0.02, -0.06));
        for (x, sign) in [(0.6, 1.0), (0.8, -1.0)] {
            let axis = Vector3::new(x, 0.5, 0.5).normalize();
            let equatorial_axis = axis.cross(&Vector3::x()).normalize();
            let initial = BodyState { axis, momentum: Vector3::zeros(), equatorial_axis };
            let problem = Problem::new(star, s, initial).unwrap();
            let found = motion(&problem);
            assert!(found.frequencies().rate("psi'").is_some_and(|rate| rate * sign > 0.2), "{found:?}");
            let value = |state: &BodyState<f64>| state.equatorial_axis.x;
            let all = lines(&found, 1e-7, value);
            let exact = crate::propagation::PhasedMotion::exact(&problem, 1e4).unwrap();
            for t in [0.0, 17.0, 4321.0] {
                let sum = all.constant + all.lines.iter().map(|line| line.value(t)).sum::<f64>();
                assert!((sum - value(&exact.state([t, 0.0]))).abs() < 1e-5, "{x} {t}: {sum}");
            }
        }
    }

    /// A free body whose spin relative to `L` is half of its precession rate: the line `(1, 0, -2)` has zero frequency, and belongs to the mean over
    /// time.
    #[test]
    fn lines_that_do_not_move_are_in_the_constant() {
        let star = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 0.5, constant_c: 0.0 };
        let axis = Vector3::new(0.75_f64.sqrt(), 0.0, 0.5);
        let (momentum, across) = (Vector3::z(), Vector3::new(0.3, 0.9, -0.2));
        let initial = BodyState { axis, momentum, equatorial_axis: axis.cross(&across).normalize() };
        let found = motion(&Problem::new(star, Matrix3::zeros(), initial).unwrap());
        let [turn, _, about_axis] = found.rates();
        assert_eq!(turn, 2.0 * about_axis.abs());
        let square = |state: &BodyState<f64>| (state.equatorial_axis + state.axis).dot(&across).powi(2);
        let all = lines(&found, 1e-12, square);
        let at = |a: f64, b: f64| square(&found.state_after_turns([a, 0.0, b]));
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            (0..32 * 32).map(|i| of(f64::from(i % 32) / 32.0, f64::from(i / 32) / 32.0)).sum::<f64>() / 1024.0
        };
        // The body returns to its initial state in two turns about L.
        let over_time = mean(&|part, _| at(2.0 * part, about_axis.signum() * part));
        assert!((all.constant - over_time).abs() < 1e-14, "{} {over_time}", all.constant);
        assert!((over_time - mean(&at)).abs() > 0.01, "no such line");
        assert!(all.left < 1e-14, "{:e}", all.left);
    }
}
