//! Reasons why a table could not be finished.

use std::fmt;

use twofold::Error;

/// Reasons why a table could not be finished.
#[derive(Debug)]
pub enum TrajectoryError {
    /// The scene lacks something that the table needs; a sentence.
    Incomplete(String),
    /// The motion, or a quantity derived from it, could not be computed.
    Motion(Error),
    /// The lines of a column could not be found.
    Lines(String, Error),
    /// A column does not exist in some state of the motion.
    Undefined(String),
    /// The rows could not be written.
    Write(csv::Error),
}

impl TrajectoryError {
    /// Whether the reader of a pipe has closed it.
    pub fn is_closed_pipe(&self) -> bool {
        match self {
            TrajectoryError::Write(error) => match error.kind() {
                csv::ErrorKind::Io(error) => error.kind() == std::io::ErrorKind::BrokenPipe,
                _ => false,
            },
            _ => false,
        }
    }
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TrajectoryError::Incomplete(lacks) => f.write_str(lacks),
            TrajectoryError::Motion(error) => write!(f, "the motion could not be computed: {error}"),
            TrajectoryError::Lines(column, error) => write!(f, "the lines of `{column}` could not be found: {error}"),
            TrajectoryError::Undefined(column) => {
                write!(
                    f,
                    "`{column}` has no lines: it is undefined in some states of the motion, where an axis is on a pole"
                )
            }
            TrajectoryError::Write(error) => write!(f, "the table could not be written: {error}"),
        }
    }
}

impl std::error::Error for TrajectoryError {}

impl From<Error> for TrajectoryError {
    fn from(error: Error) -> Self {
        TrajectoryError::Motion(error)
    }
}

impl From<csv::Error> for TrajectoryError {
    fn from(error: csv::Error) -> Self {
        TrajectoryError::Write(error)
    }
}

impl From<std::io::Error> for TrajectoryError {
    fn from(error: std::io::Error) -> Self {
        TrajectoryError::Write(error.into())
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Error, ErrorKind};

    use super::*;

    #[test]
    fn a_closed_pipe_is_no_other_fault() {
        let write = |kind| TrajectoryError::Write(Error::from(kind).into());
        assert!(write(ErrorKind::BrokenPipe).is_closed_pipe());
        assert!(!write(ErrorKind::StorageFull).is_closed_pipe());
        let mut table = csv::Writer::from_writer(Vec::new());
        let uneven =
            table.write_record(["a"]).and_then(|()| table.write_record(["a", "b"])).expect_err("two fields for one");
        assert!(!TrajectoryError::Write(uneven).is_closed_pipe());
        assert!(!TrajectoryError::Incomplete("the section [observer]".into()).is_closed_pipe());
    }
}
