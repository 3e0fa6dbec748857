//! Macros and row types shared by the register types of all machines.

use std::ops::{Add, Sub};

use super::lanes::{Lanes, ROW_LEN, RowRegister};

/// Row split over `N` registers.
#[derive(Debug, Clone, Copy)]
pub struct SplitRow<L, const N: usize>(pub [L; N]);

impl<L: Copy + Add<Output = L>, const N: usize> Add for SplitRow<L, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + o.0[i]))
    }
}

impl<L: Copy + Sub<Output = L>, const N: usize> Sub for SplitRow<L, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - o.0[i]))
    }
}

impl<L: Lanes, const N: usize> RowRegister<L::Scalar> for SplitRow<L, N> {
    #[inline(always)]
    fn read(from: &[L::Scalar; ROW_LEN]) -> Self {
        Self(std::array::from_fn(|i| L::load(from, i)))
    }
    #[inline(always)]
    fn write(self, to: &mut [L::Scalar; ROW_LEN]) {
        for (i, part) in self.0.into_iter().enumerate() {
            part.store(to, i);
        }
    }
}

/// Collects the rows of all lanes. The closure has a single call site, so that it is always
/// inlined.
#[inline(always)]
pub fn collect<L: Lanes, const N: usize, const ROWS: usize>(
    mut row: impl FnMut(usize) -> SplitRow<L, N>,
) -> [SplitRow<L, N>; ROWS] {
    let mut rows = [SplitRow([L::zero(); N]); ROWS];
    for (l, to) in rows.iter_mut().enumerate() {
        *to = row(l);
    }
    rows
}

/// Implements [`Transpose`](super::lanes::Transpose) for a register of four lanes, from the
/// transposition of four registers.
macro_rules! transpose_fours {
    ($t:ident, $number:ty, $transposed:ident) => {
        impl $crate::simd::lanes::Transpose for $t {
            type Scalar = $number;
            type Row = $crate::simd::register::SplitRow<Self, 2>;
            type Rows = [Self::Row; 4];
            #[inline(always)]
            fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
                let [p, q, r, s]: [Self::Row; 4] = $crate::simd::register::collect(row);
                let [a, b, c, d] = $transposed([p.0[0].0, q.0[0].0, r.0[0].0, s.0[0].0]);
                let [e, f, g, h] = $transposed([p.0[1].0, q.0[1].0, r.0[1].0, s.0[1].0]);
                [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
            }
            #[inline(always)]
            fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
                let [p, q, r, s] = $transposed([a.0, b.0, c.0, d.0]);
                let [t, u, v, w] = $transposed([e.0, f.0, g.0, h.0]);
                [
                    $crate::simd::register::SplitRow([Self(p), Self(t)]),
                    $crate::simd::register::SplitRow([Self(q), Self(u)]),
                    $crate::simd::register::SplitRow([Self(r), Self(v)]),
                    $crate::simd::register::SplitRow([Self(s), Self(w)]),
                ]
            }
        }
    };
}
pub(crate) use transpose_fours;

/// Implements [`Transpose`](super::lanes::Transpose) for a register of two lanes, from the two
/// interleavings of two registers.
macro_rules! transpose_twos {
    ($t:ident, $number:ty, $low:expr, $high:expr) => {
        impl $crate::simd::lanes::Transpose for $t {
            type Scalar = $number;
            type Row = $crate::simd::register::SplitRow<Self, 4>;
            type Rows = [Self::Row; 2];
            #[inline(always)]
            fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
                let [p, q]: [Self::Row; 2] = $crate::simd::register::collect(row);
                let ([a, b, c, d], [e, f, g, h]) = (p.0, q.0);
                [
                    Self($low(a.0, e.0)),
                    Self($high(a.0, e.0)),
                    Self($low(b.0, f.0)),
                    Self($high(b.0, f.0)),
                    Self($low(c.0, g.0)),
                    Self($high(c.0, g.0)),
                    Self($low(d.0, h.0)),
                    Self($high(d.0, h.0)),
                ]
            }
            #[inline(always)]
            fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
                [
                    $crate::simd::register::SplitRow([
                        Self($low(a.0, b.0)),
                        Self($low(c.0, d.0)),
                        Self($low(e.0, f.0)),
                        Self($low(g.0, h.0)),
                    ]),
                    $crate::simd::register::SplitRow([
                        Self($high(a.0, b.0)),
                        Self($high(c.0, d.0)),
                        Self($high(e.0, f.0)),
                        Self($high(g.0, h.0)),
                    ]),
                ]
            }
        }
    };
}
pub(crate) use transpose_twos;

/// Defines a type of one register and implements [`Lanes`] by the intrinsics given. They are unsafe
/// where the machine may lack them: users of the type have checked that it does not.
macro_rules! register {
    (
        $(#[$doc:meta])*
        $t:ident: $width:literal x $number:ty => $register:ty, mask $mask:ty;
        $splat:expr; $load:expr; $store:expr; $sqrt:expr;
        $add:expr; $sub:expr; $mul:expr; $div:expr; $neg:expr; $min:expr;
        $less_than:expr; $select:expr; $mask_op:expr; $any:expr
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub struct $t(pub(crate) $register);
        $crate::simd::register::register!(@ $t, Add, add, $add);
        $crate::simd::register::register!(@ $t, Sub, sub, $sub);
        $crate::simd::register::register!(@ $t, Mul, mul, $mul);
        $crate::simd::register::register!(@ $t, Div, div, $div);
        #[allow(unused_unsafe, reason = "in WebAssembly these operations are safe")]
        impl std::ops::Neg for $t {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(unsafe { $neg(self.0) })
            }
        }
        impl std::ops::AddAssign for $t {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl std::ops::SubAssign for $t {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
        #[allow(unused_unsafe, reason = "some operations are safe, such as those on integer masks")]
        impl $crate::simd::lanes::Lanes for $t {
            type Mask = $mask;
            const WIDTH: usize = $width;
            #[inline(always)]
            fn splat(x: $number) -> Self {
                Self(unsafe { $splat(x) })
            }
            #[inline(always)]
            fn load<const N: usize>(from: &[$number; N], part: usize) -> Self {
                assert!(part < N / $width);
                // SAFETY: the part lies within the array; loads need no alignment.
                Self(unsafe { $load(from.as_ptr().add($width * part).cast()) })
            }
            #[inline(always)]
            fn store<const N: usize>(self, to: &mut [$number; N], part: usize) {
                assert!(part < N / $width);
                // SAFETY: as for `load`.
                unsafe { $store(to.as_mut_ptr().add($width * part).cast(), self.0) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> $mask {
                unsafe { $less_than(self.0, other.0) }
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(unsafe { $select(mask, yes.0, no.0) })
            }
            #[inline(always)]
            fn mask(mask: $mask, x: Self) -> Self {
                Self(unsafe { $mask_op(mask, x.0) })
            }
            #[inline(always)]
            fn any(mask: $mask) -> bool {
                unsafe { $any(mask) }
            }
        }
    };
    (@ $t:ident, $trait:ident, $name:ident, $op:expr) => {
        #[allow(unused_unsafe, reason = "in WebAssembly these operations are safe")]
        impl std::ops::$trait for $t {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(unsafe { $op(self.0, o.0) })
            }
        }
    };
}
pub(crate) use register;
