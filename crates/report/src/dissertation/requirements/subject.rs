//! Column under examination, and answers to requirements.

use teeter_dissertation::jenga3d::Constants;
use teeter_scene::{Scene, TowerOptions, named, tower};

use crate::dissertation::column::Column;
use crate::dissertation::played::Played;
use crate::dissertation::tower::Tower;
use crate::error::Error;

/// Judgement on a requirement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judgement {
    /// An experiment meets it.
    Met,
    /// An experiment does not meet it.
    NotMet,
    /// The report has no experiment for it.
    NotJudged,
}

impl Judgement {
    /// Word of the judgement.
    pub fn word(self) -> &'static str {
        match self {
            Judgement::Met => "met",
            Judgement::NotMet => "NOT MET",
            Judgement::NotJudged => "not judged",
        }
    }
}

/// Answer of an experiment.
#[derive(Debug, Clone)]
pub struct Answer {
    /// Judgement.
    pub judgement: Judgement,
    /// Figure behind the answer.
    pub evidence: String,
}

impl Answer {
    /// Answer of an experiment that meets the requirement or does not, with its evidence.
    pub fn new(met: bool, evidence: String) -> Self {
        Self { judgement: if met { Judgement::Met } else { Judgement::NotMet }, evidence }
    }

    /// Answer that the report cannot give, with the reason.
    pub fn not_judged(reason: &str) -> Self {
        Self { judgement: Judgement::NotJudged, evidence: reason.to_owned() }
    }
}

/// Column under examination.
pub struct Subject<'a> {
    /// Column.
    pub column: &'static Column,
    /// Constants of the 2003 method.
    pub constants: &'a Constants,
    /// Twelve moves.
    pub moves: &'a Played,
    /// Frame rates of towers of [`ROWS`] rows on this machine, frames per second.
    pub rates: &'a [f64],
}

/// Heights of the towers whose frame rates are judged, rows: the minimum of section 3.5, what it
/// calls satisfactory, and its aim.
pub const ROWS: [u32; 3] = [6, 9, 18];

impl Subject<'_> {
    /// Builds a scene.
    ///
    /// # Errors
    /// When the scene is not valid.
    pub fn build(&self, scene: &Scene) -> Result<Tower, Error> {
        (self.column.build)(scene, self.constants)
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
