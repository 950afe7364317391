//! The section `[lorentz_violation]`.

use nalgebra::Matrix3;
use twofold::lorentz_violation::{PrincipalCoefficients, coefficients_from_preferred_frame, principal_frame};

use super::error::Fault;
use super::section::{Entry, Section};

/// `s^IJ` in the inertial frame of the file, and its principal frame.
pub(super) struct Violation {
    pub(super) tensor: Matrix3<f64>,
    pub(super) coefficients: PrincipalCoefficients<f64>,
    /// Rows: principal axes X, Y, Z in the frame of the file.
    pub(super) principal_from_given: Matrix3<f64>,
}

const COEFFICIENT: &str = "a number from -1 to 1: the violation is small";

pub(super) fn read(section: &Section<'_>) -> Result<Violation, Fault> {
    section.only(&["eigenvalues", "tensor", "alpha_2", "w"])?;
    for (first, second) in [
        ("eigenvalues", "tensor"),
        ("eigenvalues", "alpha_2"),
        ("eigenvalues", "w"),
        ("tensor", "alpha_2"),
        ("tensor", "w"),
    ] {
        section.not_both(first, second)?;
    }
    if let Some(entry) = section.optional("eigenvalues") {
        eigenvalues(&entry)
    } else if let Some(entry) = section.optional("tensor") {
        tensor(&entry)
    } else if section.has("alpha_2") || section.has("w") {
        preferred_frame(section)
    } else {
        Err(section.missing(
            "`lorentz_violation.eigenvalues`, `lorentz_violation.tensor`, or `lorentz_violation.alpha_2` with \
             `lorentz_violation.w`",
        ))
    }
}

fn eigenvalues(entry: &Entry<'_>) -> Result<Violation, Fault> {
    let values = coefficients(entry, "a list of three numbers, [s^XX, s^YY, s^ZZ]")?;
    let coefficients = PrincipalCoefficients::new(values);
    Ok(Violation { tensor: coefficients.tensor(), coefficients, principal_from_given: Matrix3::identity() })
}

fn tensor(entry: &Entry<'_>) -> Result<Violation, Fault> {
    let allowed = "three rows of three numbers, symmetric";
    let rows = entry.list(allowed)?;
    if rows.len() != 3 {
        return Err(entry.refuse(allowed));
    }
    let mut tensor = Matrix3::zeros();
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in coefficients(row, "a row of three numbers")?.into_iter().enumerate() {
            tensor[(i, j)] = value;
        }
    }
    let frame = principal_frame(&tensor).map_err(|error| entry.refuse(&format!("{allowed} ({error})")))?;
    Ok(Violation { tensor, coefficients: frame.coefficients, principal_from_given: frame.principal_from_given })
}

/// Eq. (5) `[replace]`. The principal axis Z is along `w`; X and Y are any two normal to it.
fn preferred_frame(section: &Section<'_>) -> Result<Violation, Fault> {
    let alpha_2_entry = section.required("alpha_2", "the PPN parameter")?;
    let alpha_2 = alpha_2_entry.number()?;
    let w_entry = section.required("w", "velocity relative to the preferred frame, three numbers in units of c")?;
    let allowed = "three numbers, in units of c, with 0 < |w| < 1";
    let w = w_entry.vector(allowed)?;
    let speed = w.norm();
    if !(speed > 0.0 && speed < 1.0) {
        return Err(w_entry.refuse(allowed));
    }
    let largest = alpha_2 * speed * speed;
    if largest.is_nan() || largest.abs() > 1.0 {
        return Err(alpha_2_entry.refuse("a number with |alpha_2| |w|^2 <= 1: the violation is small"));
    }
    let z = w / speed;
    let x = z.cross(&Matrix3::identity().column(z.iamin())).normalize();
    let y = z.cross(&x);
    Ok(Violation {
        tensor: coefficients_from_preferred_frame(alpha_2, &w),
        coefficients: PrincipalCoefficients::new([0.0, 0.0, -largest]),
        principal_from_given: Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]),
    })
}

fn coefficients(entry: &Entry<'_>, allowed: &str) -> Result<[f64; 3], Fault> {
    let entries = entry.list(allowed)?;
    let [x, y, z] = entries.as_slice() else { return Err(entry.refuse(allowed)) };
    let read = |entry: &Entry<'_>| entry.number_where(COEFFICIENT, |s| s.abs() <= 1.0);
    Ok([read(x)?, read(y)?, read(z)?])
}
