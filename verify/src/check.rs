//! A check: written once as data, run individually by `cargo test` and listed by `twofold verify`.

use nalgebra::{Dim, Matrix, RawStorage};
use twofold::dynamics::RotationState;

/// The kinds of evidence: what a check compares with what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// An identity of rational functions over a prime field: no tolerance.
    Exact,
    /// A formula of the paper against automatic derivatives of the Lagrangian or a time jet.
    Autodiff,
    /// A different method or a different source.
    Oracle,
    /// An invariant, a symmetry or a round trip at random points of the physical domain.
    Property,
    /// The error of an approximation against the numerical motion: its order and its range of validity.
    Regime,
}

impl Kind {
    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Exact => "exact",
            Kind::Autodiff => "autodiff",
            Kind::Oracle => "oracle",
            Kind::Property => "property",
            Kind::Regime => "regime",
        }
    }
}

/// The condition on the measured figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// The figure is at most this; NaN fails.
    AtMost(f64),
    /// The figure is at least this and finite; NaN fails.
    AtLeast(f64),
    /// The figure lies in this closed interval; NaN fails.
    Within(f64, f64),
}

impl Bound {
    /// Whether `figure` satisfies the bound.
    pub fn holds(self, figure: f64) -> bool {
        match self {
            Bound::AtMost(limit) => figure <= limit,
            Bound::AtLeast(limit) => figure >= limit && figure.is_finite(),
            Bound::Within(low, high) => low <= figure && figure <= high,
        }
    }
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Bound::AtMost(limit) => write!(f, "<= {}", short(limit)),
            Bound::AtLeast(limit) => write!(f, ">= {}", short(limit)),
            Bound::Within(low, high) => write!(f, "in [{}, {}]", short(low), short(high)),
        }
    }
}

/// Four significant digits without trailing zeros.
fn short(x: f64) -> String {
    if x == 0.0 || (1e-2..1e5).contains(&x.abs()) {
        return ((x * 1e4).round() / 1e4).to_string();
    }
    let text = format!("{x:.3e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
}

/// The figure that a check measured, with what is needed to find the worst case again (seed, point, table).
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The figure to which the bound applies.
    pub figure: f64,
    /// One line: the place of the worst case, or the numbers behind the figure.
    pub detail: String,
}

impl Measured {
    /// A figure and its line of detail.
    pub fn new(figure: f64, detail: impl Into<String>) -> Self {
        Self { figure, detail: detail.into() }
    }
}

/// One check.
#[derive(Clone, Copy)]
pub struct Check {
    /// Kebab-case id without a prefix for the kind: `euler-lagrange-equations`.
    pub id: &'static str,
    /// Kind of evidence.
    pub kind: Kind,
    /// Numbers of the equations that it concerns, in order: `&[25]`.
    pub equations: &'static [u8],
    /// The statement, one sentence.
    pub statement: &'static str,
    /// What the figure is: `mismatches at 24 points`, `largest error / ulp of the sum of magnitudes`.
    pub figure: &'static str,
    /// The bound on the figure.
    pub bound: Bound,
    /// Origin of the bound, in one sentence.
    pub reason: &'static str,
    /// Measures the figure. An error is a failure of the check.
    pub measure: fn() -> Result<Measured, String>,
}

/// The checks of a module, as its function `checks()`. The doc comment of a row is the statement of the check. A row is either one check with
/// the function that measures its figure, or an [`Identity`](crate::identity::Identity): the function of a point whose components vanish, the
/// kind of its check in floating point ([`Kind::Autodiff`] if it contains derivatives), id and equation numbers.
macro_rules! checks {
    (@rows $checks:ident) => {};
    (@rows $checks:ident $(#[doc = $statement:literal])+ $residuals:ident: $kind:ident $id:literal $equations:tt; $($rest:tt)*) => {
        {
            struct Row;
            impl $crate::identity::Identity for Row {
                const ID: &'static str = $id;
                const ROUNDED: ($crate::check::Kind, &'static str) =
                    ($crate::check::Kind::$kind, $crate::check::checks!(@rounded $kind $id));
                const EQUATIONS: &'static [u8] = &$equations;
                const STATEMENT: &'static str = concat!($($statement),+).trim_ascii();
                fn residuals<F: $crate::derivation::Differentiable>(point: &$crate::random::Point<F>) -> Vec<F> {
                    $residuals(point)
                }
            }
            $checks.extend($crate::identity::checks::<Row>());
        }
        $crate::check::checks!(@rows $checks $($rest)*);
    };
    (
        @rows $checks:ident $(#[doc = $statement:literal])+ $kind:ident $id:literal $equations:tt: $measure:expr;
        $bound:ident $limits:tt $figure:literal; because $reason:literal; $($rest:tt)*
    ) => {
        $checks.push($crate::check::Check {
            id: $id,
            kind: $crate::check::Kind::$kind,
            equations: &$equations,
            statement: const { concat!($($statement),+).trim_ascii() },
            figure: $figure,
            bound: $crate::check::Bound::$bound $limits,
            reason: $reason,
            measure: $measure,
        });
        $crate::check::checks!(@rows $checks $($rest)*);
    };
    (@rounded Autodiff $id:literal) => { concat!($id, "-autodiff") };
    (@rounded Property $id:literal) => { concat!($id, "-rounding") };
    ($($rows:tt)+) => {
        /// The checks of this subject.
        pub fn checks() -> Vec<$crate::check::Check> {
            let mut checks = Vec::new();
            $crate::check::checks!(@rows checks $($rows)+);
            checks
        }
    };
}
pub(crate) use checks;

/// The result of a check.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The measured figure, or the reason why there is none.
    pub measured: Result<Measured, String>,
    /// Whether the bound holds.
    pub passed: bool,
    /// Wall-clock time spent.
    pub seconds: f64,
}

impl Check {
    /// Runs the check. A panic inside counts as a failure with its message.
    pub fn run(&self) -> Outcome {
        let start = std::time::Instant::now();
        let measured = std::panic::catch_unwind(self.measure).unwrap_or_else(|panic| {
            let message = panic
                .downcast_ref::<String>()
                .map(String::as_str)
                .or_else(|| panic.downcast_ref::<&str>().copied())
                .unwrap_or("panic without a message");
            Err(format!("panicked: {message}"))
        });
        let passed = measured.as_ref().is_ok_and(|m| self.bound.holds(m.figure));
        Outcome { measured, passed, seconds: start.elapsed().as_secs_f64() }
    }
}

/// Keeps the largest of many figures and its place. NaN counts as infinite.
#[derive(Debug, Clone)]
pub struct Worst {
    measured: Measured,
    cases: usize,
}

impl Default for Worst {
    fn default() -> Self {
        Self { measured: Measured::new(f64::NEG_INFINITY, ""), cases: 0 }
    }
}

impl Worst {
    /// Takes one figure; `place` is called only if the figure is the largest so far.
    pub fn see(&mut self, figure: f64, place: impl FnOnce() -> String) {
        let figure = if figure.is_nan() { f64::INFINITY } else { figure };
        self.cases += 1;
        if figure > self.measured.figure {
            self.measured = Measured::new(figure, place());
        }
    }

    /// Takes the figure of one case. Not generic: it would otherwise be compiled once for each check.
    fn see_case(&mut self, found: &Measured, case: &dyn std::fmt::Debug) {
        self.see(found.figure, || format!("{case:?} {}", found.detail));
    }

    /// The largest figure, or an error if there was no figure: a check without cases shows nothing.
    pub fn finish(self) -> Result<Measured, String> {
        match self.cases {
            0 => Err("no case was measured".into()),
            cases => Ok(Measured::new(self.measured.figure, format!("worst of {cases}: {}", self.measured.detail))),
        }
    }
}

/// The result of a case: a figure, or the worst figure of cases within it.
pub trait Figure {
    /// The figure and its line of detail; `None` for a case that shows nothing. Such a case is not counted.
    fn measured(self) -> Option<Measured>;
}

impl Figure for f64 {
    fn measured(self) -> Option<Measured> {
        Some(Measured::new(self, ""))
    }
}

impl Figure for Measured {
    fn measured(self) -> Option<Measured> {
        Some(self)
    }
}

impl<F: Figure> Figure for Option<F> {
    fn measured(self) -> Option<Measured> {
        self.and_then(F::measured)
    }
}

/// The largest figure over some cases, and the case in which it occurred.
pub(crate) fn worst_of<C: std::fmt::Debug, F: Figure>(
    cases: impl IntoIterator<Item = C>,
    mut figure: impl FnMut(&C) -> Result<F, String>,
) -> Result<Measured, String> {
    let mut worst = Worst::default();
    for case in cases {
        if let Some(found) = figure(&case)?.measured() {
            worst.see_case(&found, &case);
        }
    }
    worst.finish()
}

/// The smallest figure over some cases, and the case in which it occurred.
pub(crate) fn least_of<C: std::fmt::Debug>(
    cases: impl IntoIterator<Item = C>,
    mut figure: impl FnMut(&C) -> Result<f64, String>,
) -> Result<Measured, String> {
    let Measured { figure, detail } = worst_of(cases, |case| figure(case).map(|figure| -figure))?;
    Ok(Measured::new(-figure, detail))
}

/// The largest of some non-negative figures. NaN if one is NaN, which `f64::max` would drop, and NaN without figures: nothing was measured.
pub fn largest(figures: impl IntoIterator<Item = f64>) -> f64 {
    let more = |most: f64, x: f64| if x.is_nan() || most.is_nan() { f64::NAN } else { most.max(x) };
    figures.into_iter().reduce(more).map_or(f64::NAN, |most| if most < 0.0 { 0.0 } else { most })
}

/// As [`largest`], for figures that may fail.
pub(crate) fn largest_of<E>(figures: impl IntoIterator<Item = Result<f64, E>>) -> Result<f64, E> {
    Ok(largest_if_any(figures)?.unwrap_or(f64::NAN))
}

/// As [`largest_of`], but `None` without figures.
pub(crate) fn largest_if_any<E>(figures: impl IntoIterator<Item = Result<f64, E>>) -> Result<Option<f64>, E> {
    let figures = figures.into_iter().collect::<Result<Vec<_>, E>>()?;
    Ok((!figures.is_empty()).then(|| largest(figures)))
}

/// The smallest of some figures. NaN if one is NaN, which `f64::min` would drop, and NaN without figures.
pub fn smallest(figures: impl IntoIterator<Item = f64>) -> f64 {
    let less = |least: f64, x: f64| if x.is_nan() || least.is_nan() { f64::NAN } else { least.min(x) };
    figures.into_iter().reduce(less).unwrap_or(f64::NAN)
}

/// The largest magnitude in a matrix or vector; NaN if one component is NaN, which `amax` would drop together with those before it.
pub fn largest_component<R: Dim, C: Dim, S: RawStorage<f64, R, C>>(matrix: &Matrix<f64, R, C, S>) -> f64 {
    largest(matrix.iter().map(|x| x.abs()))
}

/// The largest difference between components of two states; those of `L` are in units of `unit`.
pub fn largest_difference<X: RotationState<f64>>(a: &X, b: &X, unit: f64) -> f64 {
    let ([n, l, e], [n_b, l_b, e_b]) = (a.vectors(), b.vectors());
    largest([n - n_b, (l - l_b) / unit, e - e_b].iter().map(largest_component))
}
