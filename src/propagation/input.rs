//! What a motion is not computed from.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::propagation::ACCURACY_RANGE;
use crate::scalar::{Real, real_part};

/// Places of the vectors of a state.
const AXIS: usize = 0;
const MOMENTUM: usize = 1;
const EQUATORIAL_AXIS: usize = 2;

/// Refuses what is not finite, not a frame, or out of range.
pub(crate) fn check_input<S: Real, const V: usize>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    vectors: &[Vector3<S>; V],
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
    let asymmetry = (s - s.transpose()).map(S::re).amax();
    Error::unless(
        asymmetry <= 1e-12 * s.map(S::re).amax(),
        "largest |s^IJ - s^JI|",
        asymmetry,
        "at most 1e-12 of the largest entry: s^IJ is symmetric",
    )?;
    let vectors = vectors.each_ref().map(real_part);
    for component in vectors[MOMENTUM].iter() {
        Error::unless(component.is_finite(), "component of L", *component, "a finite number")?;
    }
    let unit = |vector: &Vector3<f64>, name| {
        let length = vector.norm();
        Error::unless((length - 1.0).abs() < 1e-9, name, length, "one, to 1e-9")
    };
    let axis = &vectors[AXIS];
    unit(axis, "length of the axis n")?;
    if let Some(equatorial_axis) = vectors.get(EQUATORIAL_AXIS) {
        unit(equatorial_axis, "length of the axis e_x")?;
        let overlap = axis.dot(equatorial_axis);
        Error::unless(overlap.abs() < 1e-9, "n . e_x", overlap, "zero, to 1e-9")?;
    }
    Ok(())
}

/// Refuses a time outside the span of a motion, whose ends may be in either order.
pub(crate) fn check_time((first, last): (f64, f64), t: f64) -> Result<(), Error> {
    Error::unless(
        first.min(last) <= t && t <= first.max(last),
        "time t",
        t,
        "within the span for which the motion was asked",
    )
}
