//! Cluster: bodies that may touch each other within a frame, with all that is needed to step them
//! independently of other clusters.

pub mod energy;
pub mod frame;
pub mod island;
pub mod partition;
pub mod rest;
pub mod sync;
pub mod travel_budget;

use teeter_scene::Form;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::collision::cached_pair::CachedPair;
use crate::collision::contacts::Contacts;
use crate::collision::manifold::{Manifold, key};
use crate::kernel::any_kernel::AnyKernel;
use crate::kernel::packing::Packing;
use crate::lattice::particles::Particles;
use crate::params::Params;

/// Bodies that may touch each other within a frame. Body indices within the cluster count from 0,
/// in the order of the bodies of the world.
#[derive(Debug, Clone)]
pub struct Cluster {
    /// Indices of the bodies in the world, in ascending order.
    pub ids: Vec<u32>,
    pub shapes: Shapes,
    pub bodies: Bodies,
    /// Particles of each body; empty for rigid bodies.
    pub particles: Vec<Particles>,
    pub contacts: Contacts,
    pub kernel: AnyKernel,
    pub packing: Packing,
    /// Upper bound of the energy of a body within the frame, J, see [`energy`]; set at its start.
    pub energy: f64,
}

impl Cluster {
    /// Cluster without bodies.
    pub fn new(params: &Params, form: Form) -> Self {
        Self {
            ids: Vec::new(),
            shapes: Shapes::default(),
            bodies: Bodies::default(),
            contacts: Contacts::default(),
            particles: Vec::new(),
            kernel: AnyKernel::new(params, form),
            packing: Packing::default(),
            energy: 0.0,
        }
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns true if forces move any body.
    pub fn is_awake(&self) -> bool {
        (0..self.len()).any(|i| self.bodies.is_active(i))
    }

    /// Upper bound of the speed of its bodies' points, m/s.
    pub fn max_speed(&self) -> f64 {
        (0..self.len()).map(|i| self.bodies.max_point_speed(&self.shapes, i)).fold(0.0, f64::max)
    }

    /// Appends body `i` of `from`, without its manifolds.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.ids.push(from.ids[i]);
        self.shapes.push(&from.shapes, i);
        self.bodies.push(&from.bodies, i);
        self.particles.extend(from.particles.get(i));
        self.contacts.bounds.push(from.contacts.bounds[i]);
        self.contacts.swept.push(from.contacts.swept[i]);
    }

    /// Copies manifolds and cached pairs of another cluster. `index` maps its body indices to those
    /// of this cluster; what belongs to bodies that it maps to none is left out.
    pub fn adopt(&mut self, from: &Contacts, index: impl Fn(u32) -> Option<u32>) {
        let index = |i: u32| if i == FLOOR { Some(FLOOR) } else { index(i) };
        for manifold in &from.manifolds {
            if let (Some(a), Some(b)) = (index(manifold.a), index(manifold.b)) {
                self.contacts.manifolds.push(Manifold { a, b, ..manifold.clone() });
            }
        }
        self.contacts.manifolds.sort_by_key(|m| key(m.a, m.b));
        for cached in &from.cache {
            if let [Some(low), Some(high)] = cached.pair.map(&index) {
                self.contacts.cache.push(CachedPair { pair: [low, high], ..*cached });
            }
        }
        self.contacts.cache.sort_by_key(CachedPair::key);
    }
}
