//! Lanes in wasm's 128-bit registers: two for f32, four for f64.

use std::arch::wasm32::*;

use super::{LANES, Lanes, in_quarters, operators};

/// Eight f32 in two registers.
#[derive(Debug, Clone, Copy)]
pub struct F32([v128; 2]);
/// Eight f64 in four.
#[derive(Debug, Clone, Copy)]
pub struct F64([v128; 4]);

operators!(F32, |a, b| f32x4_add(a, b), f32x4_sub(a, b), f32x4_mul(a, b), f32x4_div(a, b), |c| f32x4_neg(c));
operators!(F64, |a, b| f64x2_add(a, b), f64x2_sub(a, b), f64x2_mul(a, b), f64x2_div(a, b), |c| f64x2_neg(c));

macro_rules! lanes {
    ($t:ident, $r:ty, $n:literal, $splat:ident, $sqrt:ident, $less:ident) => {
        type Number = $r;
        type Mask = [v128; $n];
        #[inline(always)]
        fn splat(x: $r) -> Self {
            Self([$splat(x); $n])
        }
        #[inline(always)]
        fn load(from: &[$r; LANES]) -> Self {
            // SAFETY: the reference covers eight numbers, which is all the registers; loads need no alignment
            Self(std::array::from_fn(|i| unsafe { v128_load(from.as_ptr().cast::<v128>().add(i)) }))
        }
        #[inline(always)]
        fn store(self, to: &mut [$r; LANES]) {
            for (i, part) in self.0.into_iter().enumerate() {
                // SAFETY: as for loads
                unsafe { v128_store(to.as_mut_ptr().cast::<v128>().add(i), part) }
            }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            // intrinsics are no `Fn`: the closures are needed
            Self(self.0.map(|x| $sqrt(x)))
        }
        #[inline(always)]
        fn less(self, other: Self) -> Self::Mask {
            std::array::from_fn(|i| $less(self.0[i], other.0[i]))
        }
        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            Self(std::array::from_fn(|i| v128_bitselect(yes.0[i], no.0[i], mask[i])))
        }
        #[inline(always)]
        fn any(mask: Self::Mask) -> bool {
            mask.into_iter().any(|x| v128_any_true(x))
        }
        #[inline(always)]
        fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
            std::array::from_fn(|i| v128_and(a[i], b[i]))
        }
    };
}

impl Lanes for F32 {
    lanes!(F32, f32, 2, f32x4_splat, f32x4_sqrt, f32x4_lt);
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        in_quarters(rows.map(|r| r.0), quarter).map(Self)
    }
}

#[inline(always)]
fn quarter([a, b, c, d]: [v128; 4]) -> [v128; 4] {
    let (ab0, ab1) = (i32x4_shuffle::<0, 4, 1, 5>(a, b), i32x4_shuffle::<2, 6, 3, 7>(a, b));
    let (cd0, cd1) = (i32x4_shuffle::<0, 4, 1, 5>(c, d), i32x4_shuffle::<2, 6, 3, 7>(c, d));
    [
        i32x4_shuffle::<0, 1, 4, 5>(ab0, cd0),
        i32x4_shuffle::<2, 3, 6, 7>(ab0, cd0),
        i32x4_shuffle::<0, 1, 4, 5>(ab1, cd1),
        i32x4_shuffle::<2, 3, 6, 7>(ab1, cd1),
    ]
}

impl Lanes for F64 {
    lanes!(F64, f64, 4, f64x2_splat, f64x2_sqrt, f64x2_lt);
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        // sixteen blocks of 2 x 2
        std::array::from_fn(|j| {
            Self(std::array::from_fn(|i| {
                let (upper, lower) = (rows[2 * i].0[j / 2], rows[2 * i + 1].0[j / 2]);
                if j % 2 == 0 { i64x2_shuffle::<0, 2>(upper, lower) } else { i64x2_shuffle::<1, 3>(upper, lower) }
            }))
        })
    }
}
