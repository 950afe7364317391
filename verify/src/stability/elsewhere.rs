//! Public functions without a case, with the reason.

/// Paths (a type for all of its methods) and the reason why no sweep measures them.
pub const ELSEWHERE: &[(&[&str], &str)] = &[];
