//! Seeded random points of the physical domain or of the prime field.

use crate::prelude::*;

pub use twofold_scene::random::Random;

/// The largest figure over `count` cases, each drawn with the random numbers of a seed.
pub(crate) fn worst_of_draws<F: Figure>(
    seed: u64,
    count: usize,
    mut figure: impl FnMut(&mut Random) -> Result<F, String>,
) -> Result<Measured, String> {
    let mut random = Random::with_seed(seed);
    worst_of((0..count).map(|case| format!("case {case} of seed {seed}")), |_| figure(&mut random))
}

/// A number that can be drawn from a range; in a field without order, any element.
pub trait Drawn: Scalar {
    /// A random number from the range.
    fn draw(random: &mut Random, low: f64, high: f64) -> Self;
}

impl Drawn for f64 {
    fn draw(random: &mut Random, low: f64, high: f64) -> Self {
        random.within(low, high)
    }
}

impl Drawn for Conditioned {
    fn draw(random: &mut Random, low: f64, high: f64) -> Self {
        Self::new(random.within(low, high))
    }
}

impl Drawn for Fp {
    fn draw(random: &mut Random, _: f64, _: f64) -> Self {
        Self::new(random.word())
    }
}

/// A body, its coefficients for Lorentz violation and a state of motion, all independent of each other.
#[derive(Debug, Clone, Copy)]
pub struct Point<F> {
    /// A spheroid.
    pub spheroid: RigidSpheroid<F>,
    /// Another body, with three moments of inertia.
    pub inertia: PrincipalInertia<F>,
    /// The tensor `U^ij` of that body (symmetric, six components) in the body frame.
    pub potential_energy_tensor: Matrix3<F>,
    /// Eigenvalues of `s^IJ`.
    pub s: PrincipalCoefficients<F>,
    /// Another symmetric `s^IJ`, in a frame that is not principal.
    pub s_inertial: Matrix3<F>,
    /// Angles.
    pub angles: EulerAngles<F>,
    /// Their rates.
    pub rates: EulerRates<F>,
    /// Their accelerations, which satisfy no equation of motion.
    pub accelerations: EulerRates<F>,
    /// Angles of a fixed rotation of the inertial frame.
    pub frame: EulerAngles<F>,
    /// Derivatives of an arbitrary potential by the angles.
    pub gradient: Vector3<F>,
    /// Four more numbers between -1 and 1.
    pub numbers: [F; 4],
}

impl<F: Drawn> Point<F> {
    /// A random point: inertias and `C` in `[1/2, 2)`, coefficients in `(-0.1, 0.1)`, rates in `(-2, 2)`, inclinations at
    /// least 0.2 rad from the poles (points closer to a pole are left to the regular equations).
    pub fn draw(random: &mut Random) -> Self {
        let positive = |random: &mut Random| F::draw(random, 0.5, 2.0);
        let angles = |random: &mut Random| EulerAngles {
            alpha: F::draw(random, -3.1, 3.1),
            beta: F::draw(random, 0.2, 2.9),
            gamma: F::draw(random, -3.1, 3.1),
        };
        let rates = |random: &mut Random| EulerRates {
            alpha: F::draw(random, -2.0, 2.0),
            beta: F::draw(random, -2.0, 2.0),
            gamma: F::draw(random, -2.0, 2.0),
        };
        let numbers = |random: &mut Random, size: f64| [0; 3].map(|_| F::draw(random, -size, size));
        let symmetric = |random: &mut Random, size: f64| {
            let ([xx, yy, zz], [xy, xz, yz]) = (numbers(random, size), numbers(random, size));
            Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
        };
        Self {
            spheroid: RigidSpheroid {
                inertia_xx: positive(random),
                inertia_zz: positive(random),
                constant_c: positive(random),
            },
            inertia: PrincipalInertia { xx: positive(random), yy: positive(random), zz: positive(random) },
            potential_energy_tensor: symmetric(random, 1.0),
            s: PrincipalCoefficients::new(numbers(random, 0.1)),
            s_inertial: symmetric(random, 0.1),
            angles: angles(random),
            rates: rates(random),
            accelerations: rates(random),
            frame: angles(random),
            gradient: numbers(random, 1.0).into(),
            numbers: [0; 4].map(|_| F::draw(random, -1.0, 1.0)),
        }
    }
}
