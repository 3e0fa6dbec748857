//! Traits of the register types: lane-wise arithmetic and the transposition between rows and lanes.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Scalars in a lane array: the widest register that the target may have. Lanes never share a sum,
/// so results do not depend on it.
pub const LANES: usize = if cfg!(target_arch = "x86_64") {
    16
} else if cfg!(all(target_arch = "wasm32", target_feature = "simd128")) {
    4
} else {
    1
};
/// Scalars in a row.
pub const ROW_LEN: usize = 8;

/// Scalar type, f32 or f64, limited to the operations that round equally on every target.
pub trait Real:
    Copy
    + Default
    + PartialOrd
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// Register used with AVX-512.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Scalar = Self>;
    /// Register used with AVX2.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Scalar = Self>;
    /// Register that every machine of the target has.
    type Base: Lanes<Scalar = Self>;
    /// Largest relative rounding error.
    const HALF_ULP: f64;
    /// Rounds to the nearest value.
    fn from_f64(x: f64) -> Self;
    /// Converts exactly.
    fn to_f64(self) -> f64;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
}

/// Register of scalars, one a lane.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Transpose
{
    /// Boolean for each lane.
    type Mask: Copy;
    /// Number of lanes; divides [`LANES`].
    const WIDTH: usize;
    /// Copies a scalar to all lanes.
    fn splat(x: Self::Scalar) -> Self;
    /// Loads the part of an array that begins at [`Lanes::WIDTH`] * `part`.
    ///
    /// # Panics
    /// When the part reaches beyond the array.
    fn load<const N: usize>(from: &[Self::Scalar; N], part: usize) -> Self;
    /// Stores to the part of an array that begins at [`Lanes::WIDTH`] * `part`.
    ///
    /// # Panics
    /// When the part reaches beyond the array.
    fn store<const N: usize>(self, to: &mut [Self::Scalar; N], part: usize);
    /// Square root of each lane.
    fn sqrt(self) -> Self;
    /// Smaller of self and other; other where either is NaN.
    fn min(self, other: Self) -> Self;
    /// Compares self < other; false where either is NaN.
    fn less_than(self, other: Self) -> Self::Mask;
    /// Selects `yes` where the mask is set, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Selects `x` where the mask is set, zero elsewhere.
    fn mask(mask: Self::Mask, x: Self) -> Self;
    /// Returns true if the mask is set in any lane.
    fn any(mask: Self::Mask) -> bool;

    /// First lane.
    #[inline(always)]
    fn first(self) -> Self::Scalar {
        let mut x = [Self::Scalar::default(); LANES];
        self.store(&mut x, 0);
        x[0]
    }

    /// Rounds a number and copies it to all lanes.
    #[inline(always)]
    fn splat_f64(x: f64) -> Self {
        Self::splat(Self::Scalar::from_f64(x))
    }

    /// Zero in all lanes.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat_f64(0.0)
    }
}

/// Transposition between rows (the [`ROW_LEN`] scalars of one body) and columns (one scalar of as
/// many bodies as there are lanes). The fourth and the eighth scalar of a row are zero.
pub trait Transpose: Sized {
    /// Type of a lane.
    type Scalar: Real;
    /// Row held in registers.
    type Row: RowRegister<Self::Scalar>;
    /// Rows of all lanes.
    type Rows: IntoIterator<Item = Self::Row>;
    /// Transposes rows to columns: lane l of column i is scalar i of row l.
    fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; ROW_LEN];
    /// Transposes columns to rows, in the order of the lanes.
    fn rows(columns: [Self; ROW_LEN]) -> Self::Rows;
}

/// Row held in registers.
pub trait RowRegister<R>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// Loads from memory.
    fn read(from: &[R; ROW_LEN]) -> Self;
    /// Stores to memory.
    fn write(self, to: &mut [R; ROW_LEN]);
}
