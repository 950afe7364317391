//! Orthographic pictures of the unit sphere, of axes and of vectors.

use nalgebra::Vector3;

use super::style::{GREY, LIGHT, Line, dashed, solid};
use super::svg::{At, Page};

#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    centre: At,
    /// Length of a unit vector on the page.
    unit: f64,
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// Towards the eye.
    towards: Vector3<f64>,
}

impl View {
    /// The view with the eye at the given azimuth and elevation (degrees), the origin at `centre` of the page.
    pub(super) fn new(centre: At, unit: f64, azimuth: f64, elevation: f64) -> Self {
        let ((sa, ca), (se, ce)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        Self {
            centre,
            unit,
            right: Vector3::new(-sa, ca, 0.0),
            up: Vector3::new(-se * ca, -se * sa, ce),
            towards: Vector3::new(ce * ca, ce * sa, se),
        }
    }

    pub(super) fn at(&self, v: &Vector3<f64>) -> At {
        [self.centre[0] + self.unit * v.dot(&self.right), self.centre[1] - self.unit * v.dot(&self.up)]
    }

    /// Whether a point of the sphere is on the visible side.
    pub(super) fn in_front(&self, v: &Vector3<f64>) -> bool {
        v.dot(&self.towards) >= 0.0
    }

    /// A line on the sphere: `front` where it is visible, `back` where it is behind the sphere.
    pub(super) fn line_on_sphere(&self, page: &mut Page, points: &[Vector3<f64>], front: Line, back: Option<Line>) {
        for seen in [false, true] {
            let Some(line) = (if seen { Some(front) } else { back }) else { continue };
            let mut first = 0;
            for piece in points.chunk_by(|a, b| self.in_front(a) == self.in_front(b)) {
                // Up to the first point of the next piece, so that there is no gap.
                let end = (first + piece.len() + 1).min(points.len());
                if self.in_front(&piece[0]) == seen {
                    page.path(&points[first..end].iter().map(|v| self.at(v)).collect::<Vec<_>>(), line);
                }
                first += piece.len();
            }
        }
    }

    pub(super) fn line(&self, page: &mut Page, points: &[Vector3<f64>], line: Line) {
        page.path(&points.iter().map(|v| self.at(v)).collect::<Vec<_>>(), line);
    }

    pub(super) fn arrow(&self, page: &mut Page, head: &Vector3<f64>, line: Line) {
        page.arrow(self.centre, self.at(head), line);
    }

    /// A name beyond the head of a vector, at `distance` from it on the page.
    pub(super) fn name(&self, page: &mut Page, head: &Vector3<f64>, distance: f64, colour: &'static str, name: &str) {
        let [x, y] = self.at(head);
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        let length = dx.hypot(dy).max(1e-9);
        page.name([x + distance * dx / length, y + distance * dy / length], colour, name);
    }

    /// A name beside a point, displaced by `offset` on the page.
    pub(super) fn name_beside(&self, page: &mut Page, v: &Vector3<f64>, offset: At, colour: &'static str, name: &str) {
        let [x, y] = self.at(v);
        page.name([x + offset[0], y + offset[1]], colour, name);
    }

    /// The outline of the unit sphere, its equator and two meridians, faint.
    pub(super) fn draw_sphere(&self, page: &mut Page) {
        page.circle(self.centre, self.unit, "#fafafa", Some(solid(GREY, 0.6)));
        for (u, v) in [(Vector3::x(), Vector3::y()), (Vector3::x(), Vector3::z()), (Vector3::y(), Vector3::z())] {
            let circle = arc(&u, &v, 0.0, std::f64::consts::TAU);
            self.line_on_sphere(page, &circle, solid(LIGHT, 0.5), Some(Line { width: 0.4, ..dashed(LIGHT, 0.4) }));
        }
    }

    /// The three named axes with the given `length`; behind the surface of the unit sphere they are faint.
    pub(super) fn draw_axes(&self, page: &mut Page, length: f64, names: [&str; 3]) {
        for (axis, name) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().zip(names) {
            self.line(page, &[Vector3::zeros(), *axis], dashed(GREY, 0.6));
            page.arrow(self.at(axis), self.at(&(axis * length)), solid("#404040", 0.7));
            self.name(page, &(axis * length), 7.0, "#404040", name);
        }
    }
}

/// The arc `u cos t + v sin t` for `t` from `from` to `to`.
pub(super) fn arc(u: &Vector3<f64>, v: &Vector3<f64>, from: f64, to: f64) -> Vec<Vector3<f64>> {
    let pieces = 160;
    (0..=pieces)
        .map(|i| {
            let (sin, cos) = (from + (to - from) * f64::from(i) / f64::from(pieces)).sin_cos();
            u * cos + v * sin
        })
        .collect()
}
