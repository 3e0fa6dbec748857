//! Kernel in one of its number formats and body models.

use teeter_scene::Form;

use crate::kernel::inner_loop::Kernel;
use crate::kernel::lattice::Lattice;
use crate::kernel::rigid::Rigid;
use crate::params::{Params, Precision};

/// Kernel in one of its number formats and body models.
#[derive(Debug, Clone)]
pub enum AnyKernel {
    Single(Kernel<f32, Rigid<f32>>),
    Double(Kernel<f64, Rigid<f64>>),
    SingleLattice(Kernel<f32, Lattice<f32>>),
    DoubleLattice(Kernel<f64, Lattice<f64>>),
}

impl AnyKernel {
    /// Empty kernel.
    pub fn new(params: &Params, form: Form) -> Self {
        let width = params.width;
        match (params.precision, form) {
            (Precision::Single, Form::Rigid) => AnyKernel::Single(Kernel::new(width)),
            (Precision::Double, Form::Rigid) => AnyKernel::Double(Kernel::new(width)),
            (Precision::Single, Form::Lattice) => AnyKernel::SingleLattice(Kernel::new(width)),
            (Precision::Double, Form::Lattice) => AnyKernel::DoubleLattice(Kernel::new(width)),
        }
    }
}

/// Evaluates an expression with the kernel of any variant.
macro_rules! with_kernel {
    ($kernel:expr, |$name:ident| $body:expr) => {
        match &mut $kernel {
            $crate::kernel::any_kernel::AnyKernel::Single($name) => $body,
            $crate::kernel::any_kernel::AnyKernel::Double($name) => $body,
            $crate::kernel::any_kernel::AnyKernel::SingleLattice($name) => $body,
            $crate::kernel::any_kernel::AnyKernel::DoubleLattice($name) => $body,
        }
    };
}
pub(crate) use with_kernel;
