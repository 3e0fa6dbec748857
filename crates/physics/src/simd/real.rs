//! Register types of f32 and f64 on each target.

use super::lanes::Real;
#[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
use super::portable;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use super::simd128;
#[cfg(target_arch = "x86_64")]
use super::{avx2, avx512, sse2};

macro_rules! real {
    ($t:ty, $avx512:ty, $avx2:ty, $sse2:ty, $simd128:ty) => {
        impl Real for $t {
            #[cfg(target_arch = "x86_64")]
            type Avx512 = $avx512;
            #[cfg(target_arch = "x86_64")]
            type Avx2 = $avx2;
            #[cfg(target_arch = "x86_64")]
            type Base = $sse2;
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            type Base = $simd128;
            #[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
            type Base = portable::Plain<$t>;
            const HALF_ULP: f64 = 0.5 * <$t>::EPSILON as f64;
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$t>::sqrt(self)
            }
        }
    };
}
real!(f32, avx512::F32, avx2::F32, sse2::F32, simd128::F32);
// AVX-512 in double precision is not worth a type: f64 is the reference that f32 is tested against.
real!(f64, avx2::F64, avx2::F64, sse2::F64, simd128::F64);
