//! The sphere of directions of the angular momentum: contours of `l.(s l)`, the separatrix and the paths of motions.

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, Problem};

use super::drawing::*;
use twofold_verify::paper_examples::{COEFFICIENTS, SPIN, spheroid};

/// Levels of `l.(s l)` between the values at the three axes.
pub(super) const LEVELS: [f64; 7] = [-0.037, -0.03, -0.02, -0.01, 0.002, 0.013, 0.017];

/// Tilt of the angular momentum from the middle axis in the motion near the separatrix (rad).
const TILT: f64 = 0.05;

const SPAN: f64 = 500.0;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let near = near_separatrix()?;
    let motions: Vec<_> = subjects.iter().copied().chain([&near]).collect();
    let mut columns = vec!["t [t_c]".to_owned()];
    for motion in &motions {
        columns.extend(["X", "Y", "Z"].map(|i| format!("l_{i} of {} [1]", motion.name)));
        columns.push(format!("l.(s l) of {} [1]", motion.name));
    }
    let mut table = Table::new("", columns);
    let s = COEFFICIENTS.tensor();
    for t in times(SPAN, 5000) {
        let mut row = vec![t];
        for motion in &motions {
            let l = motion.state(t)?.momentum.normalize();
            row.extend([l.x, l.y, l.z, l.dot(&(s * l))]);
        }
        table.push(row);
    }
    Ok(Sheet { svg: draw(name, &motions, &table), caption: caption(), tables: vec![table] })
}

/// A star that spins about its symmetry axis, tilted by [`TILT`] from the middle axis.
fn near_separatrix() -> Result<Subject, String> {
    let spheroid = spheroid();
    // Tilted towards Z, so that L still circles Z.
    let axis = Vector3::new(0.0, TILT.cos(), TILT.sin());
    let state = BodyState { axis, momentum: axis * (spheroid.inertia_zz * SPIN), equatorial_axis: Vector3::x() };
    Subject::new("near Y", Problem::new(spheroid, COEFFICIENTS.tensor(), state)?, state.angles()?, SPAN)
}

/// The two closed lines with `l.(s l) = h`: about the axis of the smallest eigenvalue if `h` is below the middle one, otherwise about
/// that of the largest.
pub(super) fn contour(h: f64) -> [Vec<Vector3<f64>>; 2] {
    let [largest, middle, smallest] = [COEFFICIENTS.xx, COEFFICIENTS.yy, COEFFICIENTS.zz];
    let about_z = h < middle;
    let (own, a, b) = if about_z { (smallest, largest, middle) } else { (largest, middle, smallest) };
    let line = |sign: f64| {
        (0..=240)
            .map(|i| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 240.0).sin_cos();
                let across = ((h - own) / (a * cos * cos + b * sin * sin - own)).sqrt();
                let along = sign * (1.0 - across * across).sqrt();
                let (p, q) = (across * cos, across * sin);
                if about_z { Vector3::new(p, q, along) } else { Vector3::new(along, p, q) }
            })
            .collect()
    };
    [line(1.0), line(-1.0)]
}

/// The two great circles through the middle axis that separate motion about the largest from motion about the smallest.
pub(super) fn separatrix() -> [Vec<Vector3<f64>>; 2] {
    let (x, z) = ((COEFFICIENTS.yy - COEFFICIENTS.zz).sqrt(), (COEFFICIENTS.xx - COEFFICIENTS.yy).sqrt());
    [1.0, -1.0].map(|sign| arc(&Vector3::y(), &Vector3::new(x, 0.0, sign * z).normalize(), 0.0, std::f64::consts::TAU))
}

fn draw(name: &str, motions: &[&Subject], table: &Table) -> String {
    let height = 218.0;
    let mut page = Page::new(name, COLUMN, height);
    let view = View::new([COLUMN / 2.0, 115.0], 92.0, 40.0, 28.0);
    page.circle([COLUMN / 2.0, 115.0], 92.0, "#fafafa", Some(solid(GREY, 0.6)));
    for level in LEVELS {
        for line in contour(level) {
            view.line_on_sphere(&mut page, &line, solid(GREY, 0.5), Some(solid("#e4e4e4", 0.5)));
        }
    }
    for circle in separatrix() {
        view.line_on_sphere(&mut page, &circle, dashed(BLACK, 1.1), Some(dashed(LIGHT, 0.9)));
    }
    view.draw_axes(&mut page, 1.16, ["*X*", "*Y*", "*Z*"]);
    let colours = [BLUE, VERMILION, GREEN, PURPLE, ORANGE];
    let pale = ["#b3d0e4", "#f2c7a9", "#b0dccf", "#ead0dd", "#f5dba6"];
    for (i, _) in motions.iter().enumerate().rev() {
        let path: Vec<_> =
            table.rows.iter().map(|row| Vector3::new(row[1 + 4 * i], row[2 + 4 * i], row[3 + 4 * i])).collect();
        // sp-II and the star near Y are neighbours: distinct also in grey.
        let front: Line = if i == 4 { dash_dotted(colours[i], 1.1) } else { solid(colours[i], 1.0) };
        view.line_on_sphere(&mut page, &path, front, Some(Line { colour: pale[i], ..front }));
    }
    // Each name is at a point of its path, displaced to a free side.
    for (i, (motion, (row, offset))) in motions
        .iter()
        .zip([(0, [17.0, 4.0]), (400, [18.0, 4.0]), (100, [14.0, 8.0]), (200, [0.0, -10.0]), (0, [24.0, -4.0])])
        .enumerate()
    {
        let row = &table.rows[row];
        let v = Vector3::new(row[1 + 4 * i], row[2 + 4 * i], row[3 + 4 * i]);
        view.name_beside(&mut page, &v, offset, colours[i], &motion.name);
    }
    page.finish("Directions of the angular momentum")
}

fn caption() -> Caption {
    let s = [("xx", COEFFICIENTS.xx), ("yy", COEFFICIENTS.yy), ("zz", COEFFICIENTS.zz)];
    let numbers = s.into_iter().chain([("span", SPAN), ("tilt", TILT), ("spin", SPIN)]);
    let numbers = numbers.map(|(name, value)| (name, number(value)));
    let levels = LEVELS.map(number).join(", ");
    Caption::of("momentum-sphere", &numbers.chain([("levels", levels)]).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(l: &Vector3<f64>) -> f64 {
        l.dot(&(COEFFICIENTS.tensor() * l))
    }

    /// On each, `l.(s l)` has the value of the level; one is on either side of the axis and circles it once.
    #[test]
    fn contours_have_the_value_of_their_level() {
        for level in LEVELS {
            let lines = contour(level);
            let about = if level < COEFFICIENTS.yy { 2 } else { 0 };
            for (line, side) in lines.iter().zip([1.0, -1.0]) {
                for l in line {
                    assert!((l.norm() - 1.0).abs() < 1e-14 && (value(l) - level).abs() < 1e-15, "{level}: {l}");
                    assert!(side * l[about] > 0.0);
                }
                let azimuth = |l: &Vector3<f64>| l[(about + 2) % 3].atan2(l[(about + 1) % 3]);
                let steps = line
                    .windows(2)
                    .map(|pair| (azimuth(&pair[1]) - azimuth(&pair[0])).rem_euclid(std::f64::consts::TAU));
                let step = std::f64::consts::TAU / 240.0;
                let (mut turned, mut longest) = (0.0, 0.0_f64);
                for x in steps {
                    turned += x;
                    longest = longest.max(x);
                }
                assert!((turned - std::f64::consts::TAU).abs() < 1e-12 && longest < 1.001 * step, "{turned} {longest}");
            }
        }
    }

    /// Great circles through Y, one through each pair of opposite quadrants.
    #[test]
    fn on_the_separatrix_the_value_is_that_of_the_middle_axis() {
        for (circle, side) in separatrix().iter().zip([1.0, -1.0]) {
            assert!(
                circle.iter().all(|l| (l.norm() - 1.0).abs() < 1e-14 && (value(l) - COEFFICIENTS.yy).abs() < 1e-16)
            );
            assert!(circle.iter().all(|l| side * l.x * l.z >= -1e-30));
            let step = std::f64::consts::TAU / (circle.len() - 1) as f64;
            assert!(circle.windows(2).all(|pair| (pair[0].angle(&pair[1]) - step).abs() < 1e-12));
            assert!((circle[0] - Vector3::y()).norm() < 1e-15 && circle.iter().any(|l| l.y < -0.999));
        }
    }

    #[test]
    fn the_star_near_the_separatrix_spins_about_its_axis() {
        let near = near_separatrix().unwrap();
        let BodyState { axis, momentum, .. } = near.problem.initial();
        assert!((momentum - axis * (spheroid().inertia_zz * SPIN)).amax() < 1e-15, "{momentum}");
        assert!((axis.y.acos() - TILT).abs() < 1e-12 && axis.x == 0.0 && axis.z > 0.0);
    }

    #[test]
    fn a_caption_has_the_star_and_the_levels_that_are_drawn() {
        let parameters = "*s*^{*XX*}, *s*^{*YY*}, *s*^{*ZZ*} = 0.02, 0.01, −0.04; contours at −0.037, −0.03, −0.02, −0.01, 0.002, 0.013, 0.017; \
                          paths over 500 *t*_{c}; the star near *Y* starts 0.05 rad from it towards *Z*, with *Ω*^{*z*} = 1.";
        assert_eq!(caption().parameters, parameters);
    }

    /// The columns are the unit vectors along `L` of each motion and their `l.(s l)`; the last star spins about its symmetry axis, near Y.
    #[test]
    fn columns_are_the_directions_of_the_momentum() {
        let near = near_separatrix().unwrap();
        let start = near.problem.initial();
        assert!((start.momentum.dot(&start.axis) / near.problem.spheroid().inertia_zz - SPIN).abs() < 1e-15);
        assert!((start.axis - Vector3::new(0.0, TILT.cos(), TILT.sin())).norm() < 1e-15);
        assert!((start.momentum.normalize() - start.axis).norm() < 1e-15);
        let [example, ..] = super::super::examples().unwrap();
        let table = &sheet("x", &[&example]).unwrap().tables[0];
        for (place, motion) in [&example, &near].into_iter().enumerate() {
            for row in table.rows.iter().step_by(500) {
                let found = Vector3::from_row_slice(&row[1 + 4 * place..4 + 4 * place]);
                let l = motion.state(row[0]).unwrap().momentum;
                assert!((found - l / l.norm()).norm() < 1e-14, "{}: {found}", motion.name);
                assert!((row[4 + 4 * place] - value(&found)).abs() < 1e-16, "{}: {found}", motion.name);
            }
        }
    }
}
