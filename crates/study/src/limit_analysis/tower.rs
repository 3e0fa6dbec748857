//! Tower of rigid blocks.

use glam::{DVec2, DVec3};
use teeter_physics::REFERENCE_AREA;
use teeter_scene::{Block, Scene};

use super::contact_point::{ContactPoint, max_area};
use super::equilibrium::{displacements, equilibrium, spring_forces};
use super::error::LimitError;
use super::patch::Patch;
use crate::plan::{center, corners, top};
use crate::stiff_limit;

/// Tower of rigid blocks in equilibrium.
///
/// ```
/// use teeter_study::RigidTower;
///
/// let scene = teeter_scene::named("column").unwrap();
/// let tower = RigidTower::new(&scene)?;
/// let weight = scene.blocks[0].mass * scene.gravity;
/// assert!((tower.force_above(0) / (9.0 * weight) - 1.0).abs() < 1e-6);
/// assert!((tower.breakaway(0)?.straight_n / (scene.friction * 10.0 * weight) - 1.0).abs() < 1e-6);
/// # Ok::<(), teeter_study::LimitError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RigidTower<'a> {
    pub(super) scene: &'a Scene,
    pub(super) points: Vec<ContactPoint>,
    /// Normal force at each point, N.
    pub(super) forces: Vec<f64>,
    /// Optimum of the linear programme, J.
    work: f64,
}

impl<'a> RigidTower<'a> {
    /// Solves the equilibrium of `scene`.
    ///
    /// # Errors
    /// When a block is tilted or fixed in the air, rigid blocks cannot rest like this, or the
    /// solver gives up.
    pub fn new(scene: &'a Scene) -> Result<Self, LimitError> {
        let (points, work) = equilibrium(scene, 0.0)?;
        let forces = spring_forces(scene, &points, stiff_limit::RIGID).ok_or(LimitError::Unsolved)?;
        Ok(Self { scene, points, forces, work })
    }

    /// Returns the tower on contacts as stiff as those of the scene, which give by N / k. Where
    /// heights differ by less than that, blocks bear load that are loose on rigid contacts.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn on_springs(&self) -> Result<Self, LimitError> {
        let stiffness = self.scene.stiffness * max_area(&self.points) / REFERENCE_AREA;
        let forces = spring_forces(self.scene, &self.points, stiffness).ok_or(LimitError::Unsolved)?;
        Ok(Self { forces, ..self.clone() })
    }

    /// Checks that the tower of `scene` can rest.
    ///
    /// # Errors
    /// When it cannot, a block is tilted or fixed in the air, or the solver gives up.
    pub fn stands(scene: &Scene) -> Result<(), LimitError> {
        equilibrium(scene, 0.0).map(|_| ())
    }

    /// Returns true if rigid blocks cannot rest as in `scene`; none where there is no exact answer.
    ///
    /// ```
    /// # use teeter_study::RigidTower;
    /// let falls = |name| RigidTower::falls(&teeter_scene::named(name).unwrap());
    /// assert_eq!((falls("column"), falls("test-4"), falls("cards")), (Some(false), Some(true), None));
    /// ```
    pub fn falls(scene: &Scene) -> Option<bool> {
        match Self::stands(scene) {
            Ok(()) => Some(false),
            Err(LimitError::NoEquilibrium) => Some(true),
            Err(LimitError::Unsolved | LimitError::Unsuitable { .. }) => None,
        }
    }

    /// Scene of the tower.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Minimum work against the gaps, J. By duality it is the descent of the weights, sum m g times
    /// distance.
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Returns the rise of each centre from where it was built and its tilts along x and y: m, 1,
    /// 1.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn displacements(&self) -> Result<Vec<DVec3>, LimitError> {
        displacements(self.scene, &self.points)
    }

    /// Returns the height of the highest corner, m.
    ///
    /// # Errors
    /// When the solver gives up.
    pub fn top(&self) -> Result<f64, LimitError> {
        let corner = |(block, displacement): (&Block, DVec3)| {
            let tilt = DVec2::new(displacement.y, displacement.z);
            let rise = corners(block).into_iter().map(|p| tilt.dot(p - center(block))).fold(0.0, f64::max);
            top(block) + displacement.x + rise
        };
        Ok(self.scene.blocks.iter().zip(self.displacements()?).map(corner).fold(0.0, f64::max))
    }

    /// Returns the regions in which blocks touch, with their loads.
    pub fn patches(&self) -> Vec<Patch> {
        let mut patches: Vec<Patch> = Vec::new();
        for (point, &force) in self.points.iter().zip(&self.forces) {
            if patches.len() <= point.region {
                let &ContactPoint { below, above, torsion_ratio, .. } = point;
                patches.push(Patch { below, above, torsion_ratio, corners: Vec::new() });
            }
            patches[point.region].corners.push((point.position, force));
        }
        patches
    }

    /// Normal force on the lower face of a block, N.
    pub fn force_below(&self, block: usize) -> f64 {
        self.sum(|p| p.above == block)
    }

    /// Normal force on the upper face of a block, N.
    pub fn force_above(&self, block: usize) -> f64 {
        self.sum(|p| p.below == Some(block))
    }

    fn sum(&self, of: impl Fn(&ContactPoint) -> bool) -> f64 {
        self.points.iter().zip(&self.forces).filter(|(p, _)| of(p)).map(|(_, f)| f).sum()
    }
}
