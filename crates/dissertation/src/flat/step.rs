//! Step of a world of rigid rectangles by its contact method.

use super::rigid::{Method, Report, Rigid2D};
use super::{constraint, micro, penalty};

impl Rigid2D {
    /// Advances by one step.
    pub fn step(&mut self) -> Report {
        match self.constants.method {
            Method::Constraint => constraint::step(self),
            Method::Penalty => penalty::step(self),
            Method::MicroCollisions => micro::step(self),
        }
    }
}
