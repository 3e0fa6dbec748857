//! A cluster: bodies that may touch each other within a frame, and all that it takes to step them without looking at any others.

use teeter_scene::Form;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::broad_phase::Bound;
use crate::contacts::Contacts;
use crate::kernel::Kernel;
use crate::lattice::{Lattice, Particles};
use crate::manifold::{Manifold, key};
use crate::pack::Packing;
use crate::params::{Params, Precision};
use crate::rigid::Rigid;

/// The inner loop in one of its number formats and forms of body.
#[derive(Debug, Clone)]
pub enum Loop {
    Single(Kernel<f32, Rigid<f32>>),
    Double(Kernel<f64, Rigid<f64>>),
    SingleLattice(Kernel<f32, Lattice<f32>>),
    DoubleLattice(Kernel<f64, Lattice<f64>>),
}

impl Loop {
    /// An empty one.
    pub fn new(params: &Params, form: Form) -> Self {
        let width = params.width;
        match (params.precision, form) {
            (Precision::Single, Form::Rigid) => Loop::Single(Kernel::new(width)),
            (Precision::Double, Form::Rigid) => Loop::Double(Kernel::new(width)),
            (Precision::Single, Form::Lattice) => Loop::SingleLattice(Kernel::new(width)),
            (Precision::Double, Form::Lattice) => Loop::DoubleLattice(Kernel::new(width)),
        }
    }
}

/// Does the same with the kernel of either kind.
macro_rules! with_kernel {
    ($kernel:expr, |$name:ident| $body:expr) => {
        match &mut $kernel {
            crate::cluster::Loop::Single($name) => $body,
            crate::cluster::Loop::Double($name) => $body,
            crate::cluster::Loop::SingleLattice($name) => $body,
            crate::cluster::Loop::DoubleLattice($name) => $body,
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
    /// Those of each body; empty where bodies are rigid.
    pub particles: Vec<Particles>,
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
    pub fn new(params: &Params, form: Form) -> Self {
        Self {
            ids: Vec::new(),
            shapes: Shapes::default(),
            bodies: Bodies::default(),
            contacts: Contacts::default(),
            hull: Bound::default(),
            outgrown: false,
            particles: Vec::new(),
            kernel: Loop::new(params, form),
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
        self.particles.extend(from.particles.get(i));
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
