//! The unstable periodic motion, with the third integral of the separatrix.

use nalgebra::Vector3;

use super::plane::Wanted;
use crate::dynamics::first_integrals::FirstIntegrals;
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;

/// A state of the unstable periodic motion of given energy and spin, in which `L` oscillates about the middle principal axis of `s`. In this state
/// `n` and `L` lie in the plane of the axes of the largest and the middle eigenvalue, and `K` has an extremum in that plane. This is the `K` of
/// the separatrix.
///
/// The spin along the middle axis itself, `L = L.n n`, is another unstable motion; its `E` is fixed by the spin.
///
/// # Errors
/// [`Error::Domain`] for values that are not finite or positive, two equal eigenvalues, and an energy at which there is no extremum of `K` nearby:
/// `n` must rotate about `L`, and fast compared with the effect of the torque.
pub fn separatrix_motion(
    spheroid: &RigidSpheroid<f64>,
    s: &PrincipalCoefficients<f64>,
    energy: f64,
    spin: f64,
) -> Result<BodyState<f64>, Error> {
    let values = Vector3::new(s.xx, s.yy, s.zz);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    let gap = (values[order[0]] - values[order[1]]).min(values[order[1]] - values[order[2]]);
    Error::ensure(
        gap > 0.0,
        "least difference of two eigenvalues of s",
        gap,
        "above zero; otherwise there is no separatrix",
    )?;
    // In a plane the slope of K does not depend on its value.
    let wanted = Wanted::new(spheroid, &FirstIntegrals { energy, spin, clebsch: 0.0 })?;
    let plane = wanted.plane(&values, [order[0], order[1]]);
    let [mut left, mut right] = wanted.about_second_axis(values.max() - values.min());
    let first = plane.slope(left);
    let other = first.signum() * plane.slope(right);
    Error::ensure(
        other < 0.0,
        "slope of K along the plane of the largest and the middle eigenvalue, at one end with the sign of that at the other",
        other,
        "below zero; n turns fast about an L near the middle axis",
    )?;
    loop {
        let middle = 0.5 * (left + right);
        if middle <= left || middle >= right {
            return Ok(plane.state(middle));
        }
        if (plane.slope(middle) > 0.0) == (first > 0.0) { left = middle } else { right = middle }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::super::plane::tests::{BODY, PROLATE, S};
    use super::*;

    /// For `L` along `n`, `K` has no extremum in the range searched: its slope has the same sign at both ends.
    #[test]
    fn a_plane_without_an_extremum_is_refused() {
        for (body, strength) in [(BODY, 1.0), (PROLATE, 1.0), (BODY, 0.1), (PROLATE, 0.1)] {
            let s = S.scaled(strength);
            let spin = 1.2;
            let energy = body.inertia_zz * spin * spin / 2.0 + 0.02 * strength;
            let wanted = Wanted::new(&body, &FirstIntegrals { energy, spin, clebsch: 0.0 }).unwrap();
            let values = Vector3::new(s.xx, s.yy, s.zz);
            let slopes = wanted.about_second_axis(0.25 * strength).map(|b| wanted.plane(&values, [0, 2]).slope(b));
            match separatrix_motion(&body, &s, energy, spin) {
                Err(Error::Domain { value, .. }) => {
                    assert!(value > 0.0, "{slopes:?}");
                    assert_relative_eq!(value, slopes[0].signum() * slopes[1], max_relative = 1e-9);
                }
                other => panic!("{other:?} {slopes:?}"),
            }
        }
    }

    /// However weak the violation is, `K` has its extremum in the plane at the state found.
    #[test]
    fn weak_violations_have_a_separatrix_too() {
        for strength in [1.0, 1e-3, 1e-6] {
            let s = S.scaled(strength);
            let energy = 0.5 * 1.44 / BODY.inertia_xx;
            let state = separatrix_motion(&BODY, &s, energy, 0.1).unwrap();
            let wanted = Wanted::new(&BODY, &FirstIntegrals { energy, spin: 0.1, clebsch: 0.0 }).unwrap();
            let plane = wanted.plane(&Vector3::new(s.xx, s.yy, s.zz), [0, 2]);
            let b = state.axis.z.atan2(state.axis.x);
            let [below, above] = [-1e-9, 1e-9].map(|off| plane.slope(b + off));
            assert!(below * above < 0.0, "{strength:e}: {below:e} {above:e}");
        }
    }
}
