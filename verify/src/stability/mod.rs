//! Digits lost by kernels and solvers, relative to an oracle of 31 digits, on logarithmic sweeps into their limits.
//!
//! A [`Case`] is one sweep: a function generic over the scalar, the ranges of its inputs, the limit that the first one approaches, and the
//! allowed error. It runs on doubles, on duals and, as its own oracle, on double-double numbers; if it has constants or thresholds for doubles,
//! another formula is the oracle. [`measure`] runs all of them.
//!
//! The error of a number `f(x)` is counted in ulp of its *conditioned scale*
//!
//! ```text
//! |f| + sum_i |x_i df/dx_i|
//! ```
//!
//! with the derivatives from duals over double-double numbers. This is the precision that inputs accurate to rounding permit, so that a loss is
//! attributed to the kernel only if its inputs do not explain it. Kernel and oracle have the same exact doubles as inputs. An ulp is the
//! distance to the next double at the scale.

pub mod cases;
pub mod denormal;
mod input;
pub mod measure;
pub mod oracle;
pub mod table;

pub use input::Input;

use crate::dual::Dual;
use crate::prelude::*;

/// A function of several numbers with several results, over any scalar.
pub trait Function {
    /// The results at `x`; NaN where there are none.
    fn of<S: Real>(x: &[S]) -> Vec<S>;
}

/// A number with 31 digits, and its derivative.
pub(crate) type Wide = DoubleDouble;
pub(crate) type WideDual = Dual<DoubleDouble>;

/// The allowed error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Class {
    /// A formula of one step: 4 ulp of the conditioned scale.
    Scalar,
    /// A formula made of several kernels, or an iteration: 16 ulp.
    Composite,
    /// A larger bound, for a reason.
    Exception {
        /// Bound in ulp of the conditioned scale.
        bound: f64,
        /// The reason, with the condition number that the scale does not contain.
        reason: &'static str,
    },
}

impl Class {
    /// Bound in ulp of the conditioned scale.
    pub fn bound(self) -> f64 {
        match self {
            Class::Scalar => 4.0,
            Class::Composite => 16.0,
            Class::Exception { bound, .. } => bound,
        }
    }
}

/// The scale for the error of one of several results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Each result by its own scale.
    Each,
    /// All by one: they are parts of a turn, whatever the size of the inputs.
    Unit,
    /// All by the largest: they are the components of a vector in an arbitrary frame.
    Vector,
}

type Evaluate<T> = fn(&[T]) -> Vec<T>;

/// One sweep of one kernel.
#[derive(Clone)]
pub struct Case {
    /// Functions of the crate `twofold` that are measured.
    pub name: &'static str,
    /// The limit of the sweep, in words.
    pub limit: &'static str,
    /// Ranges of the inputs; the first one is swept.
    pub inputs: Vec<Input>,
    /// Allowed error of the values.
    pub class: Class,
    /// Allowed error of the derivatives by the first input.
    pub class_of_derivatives: Class,
    /// Scale of several results.
    pub scale: Scale,
    /// Points per round.
    pub points: usize,
    /// Whether derivatives `df/dx` are compared with `f / x`, too.
    pub natural_derivatives: bool,
    /// Name of the formula compared with it.
    pub naive_formula: &'static str,
    kernel: Evaluate<f64>,
    derivative: Option<Evaluate<Dual64>>,
    oracle: Evaluate<Wide>,
    oracle_slope: Evaluate<WideDual>,
    naive: Option<Evaluate<f64>>,
}

impl Case {
    /// A function that is its own oracle on double-double numbers: it has no constant, threshold or iteration made for doubles.
    pub fn new<K: Function>(name: &'static str, limit: &'static str, inputs: &[Input]) -> Self {
        Self {
            name,
            limit,
            inputs: inputs.to_vec(),
            class: Class::Scalar,
            class_of_derivatives: Class::Composite,
            scale: Scale::Each,
            points: measure::POINTS,
            natural_derivatives: false,
            naive_formula: "",
            kernel: K::of::<f64>,
            derivative: Some(K::of::<Dual64>),
            oracle: K::of::<Wide>,
            oracle_slope: K::of::<WideDual>,
            naive: None,
        }
    }

    /// A function on doubles only, with its oracle.
    pub fn of_doubles<O: Function>(
        name: &'static str,
        limit: &'static str,
        inputs: &[Input],
        kernel: fn(&[f64]) -> Vec<f64>,
    ) -> Self {
        Self { kernel, derivative: None, ..Self::new::<O>(name, limit, inputs) }
    }

    /// Adds the derivatives of a function that is not generic.
    pub fn with_derivatives(mut self, derivative: fn(&[Dual64]) -> Vec<Dual64>) -> Self {
        self.derivative = Some(derivative);
        self
    }

    /// Sets another formula as oracle.
    pub fn against<O: Function>(mut self) -> Self {
        self.oracle = O::of::<Wide>;
        self.oracle_slope = O::of::<WideDual>;
        self
    }

    /// Adds another formula in doubles for comparison.
    pub fn beside<N: Function>(mut self, formula: &'static str) -> Self {
        self.naive = Some(N::of::<f64>);
        self.naive_formula = formula;
        self
    }

    /// Marks a composite.
    pub fn composite(mut self) -> Self {
        self.class = Class::Composite;
        self
    }

    /// Marks results as the components of a vector.
    pub fn vector(mut self) -> Self {
        self.scale = Scale::Vector;
        self
    }

    /// Sets the number of points per round, for a slow function.
    pub fn with_points(mut self, points: usize) -> Self {
        self.points = points;
        self
    }

    /// Omits derivatives.
    pub fn values_only(mut self) -> Self {
        self.derivative = None;
        self
    }

    /// Compares errors of derivatives also with their natural size, the scale of the value over the swept input. It is for derivatives that
    /// are small differences of terms of that size.
    pub fn natural_derivatives(mut self) -> Self {
        self.natural_derivatives = true;
        self
    }

    /// Marks results as parts of a whole.
    pub fn unit(mut self) -> Self {
        self.scale = Scale::Unit;
        self
    }

    /// Sets an exception for the values.
    pub fn except(mut self, bound: f64, reason: &'static str) -> Self {
        self.class = Class::Exception { bound, reason };
        self
    }

    /// Sets an exception for the derivatives.
    pub fn derivatives_except(mut self, bound: f64, reason: &'static str) -> Self {
        self.class_of_derivatives = Class::Exception { bound, reason };
        self
    }
}

/// Functions generic over the scalar, as types. A measured one has a name and options, which are methods of [`Case`]:
/// `Angle: "angle".against::<ExactAngle>().composite(), (x) { ... }` gives `Angle::case(limit, inputs)`.
macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $name:ident $(: $label:literal $(.$how:ident $(::<$type:ty>)? ($($argument:expr),*))*,)? ($x:ident) $body:block
    )*) => {
        $(
            $(#[$doc])*
            struct $name;

            impl $crate::stability::Function for $name {
                fn of<S: twofold::Real>($x: &[S]) -> Vec<S> $body
            }

            $(
                impl $name {
                    fn case(limit: &'static str, inputs: &[$crate::stability::Input]) -> $crate::stability::Case {
                        $crate::stability::Case::new::<$name>($label, limit, inputs)$(.$how$(::<$type>)?($($argument),*))*
                    }
                }
            )?
        )*
    };
}

/// A list of inputs, with the number of repetitions if it is not one: `list![beta, component; 3]`.
macro_rules! list {
    ($($input:expr $(; $count:expr)?),* $(,)?) => {
        [$(&[$input; 1 $(- 1 + $count)?][..]),*].concat()
    };
}

pub(crate) use {functions, list};
