//! What a motion is not computed from.

use nalgebra::Matrix3;

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::ACCURACY_RANGE;
use crate::propagation::series::{AXIS, EQUATORIAL_AXIS, MOMENTUM, Vectors};
use crate::scalar::Real;

/// Refuses what is not finite, not a frame, or out of range.
pub(super) fn check_input<S: Real, const V: usize>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &Vectors<S, V>,
    span: (f64, f64),
    accuracy: f64,
) -> Result<(), Error> {
    let (least, most) = ACCURACY_RANGE;
    Error::unless(least <= accuracy && accuracy <= most, "accuracy", accuracy, "between 1e-16 and 1e-2")?;
    for time in [span.0, span.1] {
        Error::unless(time.is_finite(), "end of the time span", time, "a finite number")?;
    }
    for inertia in [spheroid.inertia_xx.re(), spheroid.inertia_zz.re()] {
        Error::unless(inertia > 0.0 && inertia.is_finite(), "moment of inertia", inertia, "above zero and finite")?;
    }
    let c = spheroid.constant_c.re();
    Error::unless(c.is_finite(), "constant C of the anisotropic self-energy", c, "a finite number")?;
    for entry in s.iter() {
        Error::unless(entry.re().is_finite(), "entry of s^IJ", entry.re(), "a finite number")?;
    }
    let state = state.map(S::re);
    for component in state.column(MOMENTUM).iter() {
        Error::unless(component.is_finite(), "component of L", *component, "a finite number")?;
    }
    let unit = |column: usize, name| {
        let length = state.column(column).norm();
        Error::unless((length - 1.0).abs() < 1e-9, name, length, "one, to 1e-9")
    };
    unit(AXIS, "length of the axis n")?;
    if V > EQUATORIAL_AXIS {
        unit(EQUATORIAL_AXIS, "length of the axis e_x")?;
        let overlap = state.column(AXIS).dot(&state.column(EQUATORIAL_AXIS));
        Error::unless(overlap.abs() < 1e-9, "n . e_x", overlap, "zero, to 1e-9")?;
    }
    Ok(())
}
