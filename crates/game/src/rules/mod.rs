//! Rules of the game: tables, what may be taken, and the referee who applies them frame by frame.

pub mod ideal;
pub mod illegal;
pub mod referee;
pub mod removable;
pub mod table;
pub mod throw;
pub mod turn;
