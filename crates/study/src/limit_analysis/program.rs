//! Linear programmes: unit, rows of balance and solver.

use microlp::{LinearExpr, Problem, Solution};

use super::error::LimitError;

/// Unit of length of the programmes, m, for coefficients near 1.
pub(super) const UNIT: f64 = 1e-2;

/// Empty equations of balance, three for each block.
pub(super) fn balance_rows(blocks: usize) -> Vec<[LinearExpr; 3]> {
    (0..blocks).map(|_| std::array::from_fn(|_| LinearExpr::empty())).collect()
}

/// Solves a programme.
///
/// # Errors
/// When the programme is infeasible or the solver gives up.
pub(super) fn solve(problem: Problem) -> Result<Solution, LimitError> {
    let solved = problem
        .solve()
        .map_err(|e| if e == microlp::Error::Infeasible { LimitError::NoEquilibrium } else { LimitError::Unsolved })?;
    solved.into_solution().map_err(|_| LimitError::Unsolved)
}
