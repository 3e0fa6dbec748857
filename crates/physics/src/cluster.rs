//! A cluster: bodies that may touch each other within a frame, and all that it takes to step them without looking at any others.

use crate::body::{Bodies, FLOOR, Shapes};
use crate::broad_phase::Bound;
use crate::contacts::Contacts;
use crate::kernel::Kernel;
use crate::manifold::{Manifold, key};
use crate::pack::Packing;
use crate::params::{Params, Precision};

/// The inner loop in one of its two number formats.
#[derive(Debug, Clone)]
pub enum Loop {
    Single(Kernel<f32>),
    Double(Kernel<f64>),
}

/// Does the same with the kernel in either format.
macro_rules! with_kernel {
    ($kernel:expr, |$name:ident| $body:expr) => {
        match &mut $kernel {
            crate::cluster::Loop::Single($name) => $body,
            crate::cluster::Loop::Double($name) => $body,
        }
    };
}
pub(crate) use with_kernel;

/// Bodies that may touch each other within a frame. Indices within count from 0 in the order of the bodies of the world.
#[derive(Debug, Clone)]
pub struct Cluster {
    /// Indices of the bodies in the world, in order.
    pub ids: Vec<u32>,
    pub shapes: Shapes,
    pub bodies: Bodies,
    pub contacts: Contacts,
    /// Bounds around all that its bodies sweep.
    pub hull: Bound,
    /// Whether a body has outgrown what it was expected to sweep.
    pub outgrown: bool,
    pub kernel: Loop,
    pub packing: Packing,
}

impl Cluster {
    /// One without bodies.
    pub fn new(params: &Params) -> Self {
        Self {
            ids: Vec::new(),
            shapes: Shapes::default(),
            bodies: Bodies::default(),
            contacts: Contacts::default(),
            hull: Bound::default(),
            outgrown: false,
            kernel: match params.precision {
                Precision::Single => Loop::Single(Kernel::new(params.width)),
                Precision::Double => Loop::Double(Kernel::new(params.width)),
            },
            packing: Packing::default(),
        }
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether forces move any body.
    pub fn is_awake(&self) -> bool {
        (0..self.len()).any(|i| self.bodies.moves(i))
    }

    /// Fastest that a point of its bodies is, m/s.
    pub fn speed(&self) -> f64 {
        (0..self.len()).map(|i| self.bodies.point_speed(&self.shapes, i)).fold(0.0, f64::max)
    }

    /// Takes body `i` of another, without its manifolds.
    pub fn push(&mut self, from: &Self, i: usize) {
        self.ids.push(from.ids[i]);
        self.shapes.push(&from.shapes, i);
        self.bodies.push(&from.bodies, i);
        self.contacts.bounds.push(from.contacts.bounds[i]);
        self.contacts.swept.push(from.contacts.swept[i]);
        self.hull = self.hull.union(&from.contacts.swept[i]);
    }

    /// Takes the manifolds of another, whose bodies have new indices by `rename`; those of which it names none stay behind.
    pub fn adopt(&mut self, from: &[Manifold], rename: impl Fn(u32) -> Option<u32>) {
        let name = |i: u32| if i == FLOOR { Some(FLOOR) } else { rename(i) };
        for manifold in from {
            if let (Some(a), Some(b)) = (name(manifold.a), name(manifold.b)) {
                self.contacts.manifolds.push(Manifold { a, b, ..manifold.clone() });
            }
        }
        self.contacts.manifolds.sort_by_key(|m| key(m.a, m.b));
    }
}
