//! Games as a player and a recorder see them.

mod common;
mod determinism;
mod hostile;
mod legality;
mod opponent;
mod play;
mod player;
mod record;
mod rules;
mod standing;
