//! The motion of a scene.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice};
use twofold::dynamics::BodyState;
use twofold::plan::{Output, PlannedMotion, Request};
use twofold::propagation::{ContinuousAngles, Motion as _};
use twofold_scene::scene_file;

use crate::arrays::{Array, Numbers};
use crate::error::raised;
use crate::pickle::{Reduced, called_with};
use crate::scene::Scene;

/// Samples assumed in the choice of the method.
const SAMPLES: usize = 1000;

/// The motion of a scene's star: its state at any time of the span, by a call. Times are in the `time_unit` of the scene.
#[pyclass(frozen, module = "twofold")]
pub struct Motion {
    of: Py<Scene>,
    scene: scene_file::Scene,
    end: f64,
    /// The method as requested.
    method: Option<String>,
    by: &'static str,
    motion: Box<PlannedMotion<BodyState<f64>>>,
}

impl Motion {
    pub fn new(
        py: Python<'_>,
        of: Py<Scene>,
        scene: scene_file::Scene,
        end: f64,
        method: Option<String>,
    ) -> PyResult<Self> {
        let span = (0.0, scene.since_start(end));
        let request = Request::new(&[Output::EquatorialAxis], span, SAMPLES, scene.tolerance);
        let (by, motion) = py
            .detach(|| {
                let plan = scene.problem.plan(&Request { method: scene.method, ..request })?;
                let by = plan.method.map_or("none", |method| method.name());
                Ok::<_, twofold::Error>((by, Box::new(plan.motion(&scene.problem)?)))
            })
            .map_err(raised)?;
        Ok(Self { of, scene, end, method, by, motion })
    }

    /// A time, if it is in the span.
    fn within(&self, t: f64) -> Result<f64, String> {
        let (start, end) = self.span();
        let (first, last, unit) = (start.min(end), start.max(end), self.scene.units.time_name);
        if (first..=last).contains(&t) {
            return Ok(t);
        }
        Err(format!("t = {t:?} {unit}: must be within the span of the motion, from {first:?} to {last:?} {unit}"))
    }

    /// Evaluates a function at times of the span.
    fn at<T>(
        &self,
        mut function: impl FnMut(f64) -> Result<T, twofold::Error>,
    ) -> impl FnMut(usize, f64) -> Result<T, String> {
        move |_, t| function(self.within(t)?).map_err(|error| error.to_string())
    }
}

#[pymethods]
impl Motion {
    /// The symmetry axis `n` in the inertial frame: an array of shape (..., 3) for times of shape (...).
    fn axis<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<Array<'py>> {
        let axis =
            |t| self.motion.axis_state_in_parts(self.scene.since_start_in_parts(t)).map(|state| state.axis.into());
        let found: Vec<[f64; 3]> = t.map(py, self.at(axis))?;
        t.shaped(py, found.into_flattened(), &[3]).map(Array)
    }

    /// The symmetry axis `n`, the angular momentum `L` and the axis `e_x` of the body: three arrays of shape (..., 3). `L` is in I_xx/t_c in the paper's units, in g cm^2/s for a physical star.
    fn state<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<(Array<'py>, Array<'py>, Array<'py>)> {
        let unit = self.scene.units.momentum;
        let state = |t| {
            let state = self.motion.state_in_parts(self.scene.since_start_in_parts(t))?;
            Ok([state.axis.into(), (state.momentum * unit).into(), state.equatorial_axis.into()])
        };
        let found: Vec<[[f64; 3]; 3]> = t.map(py, self.at(state))?;
        let all = t.shaped(py, found.into_flattened().into_flattened(), &[3, 3])?;
        let part = |k: usize| all.get_item((py.Ellipsis(), k, PySlice::full(py))).map(Array);
        Ok((part(0)?, part(1)?, part(2)?))
    }

    /// The Euler angles alpha, beta and gamma (rad), continuous (unwrapped) from the start: an array of shape (..., 3). NaN where the symmetry axis is on a pole.
    fn angles<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<Array<'py>> {
        let mut angles = ContinuousAngles::new(&*self.motion, 0.0, &self.scene.initial_angles).map_err(raised)?;
        // Turns are followed from the start.
        let at = |t| {
            let t = self.scene.since_start(t);
            match angles.at(t) {
                Ok(angles) => Ok([angles.alpha, angles.beta, angles.gamma]),
                Err(_) if self.motion.state(t)?.angles().is_err() => Ok([f64::NAN; 3]),
                Err(error) => Err(error),
            }
        };
        let found = t.map_long(py, self.at(at))?;
        t.shaped(py, found.into_flattened(), &[3]).map(Array)
    }

    /// Estimated error of the components of `n`, `e_x` and of `L` in units of its size, for the initial state in doubles. The rounding of that state is not in it
    /// (docs/scenes.md): a last digit of its rates turns the star by 2.2e-16 of the angle of its rotation, 2e-6 rad after 1e10 rad, where the error can be 1e-11.
    fn error<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<Bound<'py, PyAny>> {
        let found = t.map_long(py, self.at(|t| Ok(self.motion.error_estimate(self.scene.since_start(t)))))?;
        t.shaped(py, found, &[])
    }

    /// First and last time.
    #[getter]
    fn span(&self) -> (f64, f64) {
        (self.scene.times.start(), self.end)
    }

    /// The scene of the motion.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.of.clone_ref(py)
    }

    /// The method by which it is computed.
    #[getter]
    fn method(&self) -> &'static str {
        self.by
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (from, to) = self.span();
        Ok(format!("<Motion of {} from {from:?} to {to:?} by {}>", self.of.bind(py).repr()?, self.method()))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let options = PyDict::new(py);
        options.set_item("end", self.end)?;
        options.set_item("method", &self.method)?;
        options.set_item("tolerance", self.scene.tolerance)?;
        called_with(self.of.bind(py).getattr("motion")?, &options)
    }
}
