//! What a motion is not computed from.

use nalgebra::Matrix3;

use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::ACCURACY_RANGE;
use crate::scalar::{Real, real_part};

/// Refuses what is not finite, not a frame, or out of range.
pub(super) fn check_input<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    state: &BodyState<S>,
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
    for component in state.momentum.iter() {
        Error::unless(component.re().is_finite(), "component of L", component.re(), "a finite number")?;
    }
    let (axis, equatorial) = (real_part(&state.axis), real_part(&state.equatorial_axis));
    for (length, name) in [(axis.norm(), "length of the axis n"), (equatorial.norm(), "length of the axis e_x")] {
        Error::unless((length - 1.0).abs() < 1e-9, name, length, "one, to 1e-9")?;
    }
    let overlap = axis.dot(&equatorial);
    Error::unless(overlap.abs() < 1e-9, "n . e_x", overlap, "zero, to 1e-9")
}
