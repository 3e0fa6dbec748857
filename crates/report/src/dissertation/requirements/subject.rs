//! Column under examination, and answers to requirements.

use teeter_scene::{Scene, TowerOptions, named, tower};

use super::overlap::max_depth;
use crate::dissertation::column::Column;
use crate::dissertation::moves::{Outcome, moves, play};
use crate::dissertation::tower::Tower;
use crate::error::Error;

/// Moves of the dissertation that are played for the requirements about moves.
const MOVES: usize = 6;

/// Answer of an experiment.
#[derive(Debug, Clone)]
pub struct Answer {
    /// True when the requirement is met.
    pub met: bool,
    /// Figure behind the answer.
    pub evidence: String,
}

impl Answer {
    /// Answer with its evidence.
    pub fn new(met: bool, evidence: String) -> Self {
        Self { met, evidence }
    }
}

/// Column under examination, with the outcomes of its first moves.
pub struct Subject {
    /// Column.
    pub column: &'static Column,
    /// Outcomes of the first moves.
    pub moves: Vec<Outcome>,
    /// Maximum depth of a block in another after any of the moves, m.
    pub max_depth: f64,
}

impl Subject {
    /// Plays the first moves.
    ///
    /// # Errors
    /// When the tower cannot be built.
    pub fn new(column: &'static Column) -> Result<Self, Error> {
        let (mut outcomes, mut depth) = (Vec::new(), 0.0f64);
        play(column, &moves()[..MOVES], |tower, outcome| {
            depth = depth.max(max_depth(tower));
            outcomes.push(outcome);
        })?;
        Ok(Self { column, moves: outcomes, max_depth: depth })
    }

    /// Builds a scene.
    ///
    /// # Errors
    /// When the scene is not valid.
    pub fn build(&self, scene: &Scene) -> Result<Tower, Error> {
        (self.column.build)(scene)
    }

    /// Builds a scene of the list.
    ///
    /// # Errors
    /// When there is no scene of that name.
    pub fn build_named(&self, name: &str) -> Result<Tower, Error> {
        self.build(&scene(name)?)
    }

    /// Builds a full tower.
    ///
    /// # Errors
    /// When a tower cannot have that many rows.
    pub fn build_rows(&self, rows: u32) -> Result<Tower, Error> {
        self.build(&full_tower(rows)?)
    }
}

/// Returns a scene of the list.
pub fn scene(name: &str) -> Result<Scene, Error> {
    named(name).ok_or_else(|| Error::UnknownScene(name.to_owned()))
}

/// Returns a full tower.
pub fn full_tower(rows: u32) -> Result<Scene, Error> {
    Ok(tower(&TowerOptions { rows, ..TowerOptions::default() })?)
}
