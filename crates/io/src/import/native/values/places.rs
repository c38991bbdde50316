//! Value types that keep every bit of positions and angles.

use super::*;
use glam::{DAffine3, DMat3};

value! {
    /// A field of view in radians.
    ViewRadians(f64),
    { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": std::f64::consts::PI },
    |d| {
        let holds = |x: f64| x > 0.0 && x < std::f64::consts::PI;
        number(d, holds, "an angle between 0 and pi radians")
    }
}

number! {
    /// An angle from an axis in radians.
    AxisRadians(f64), 0.0, std::f64::consts::FRAC_PI_2, "an angle between 0 and pi/2 radians"
}

number! {
    /// An angle from an axis in degrees, not 0.
    ConeAngle(f64), 0.05, 90.0, "an angle between 0.05 and 90 degrees"
}

number! {
    /// An angle from an axis in radians, not 0.
    ConeRadians(f64), 0.0005, std::f64::consts::FRAC_PI_2, "an angle between 0.0005 and pi/2 radians"
}

value! {
    /// A direction of any length but 0; its length is kept.
    Upwards(DVec3),
    { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
    |d| {
        let vector = Vector::deserialize(d)?.0;
        match vector.try_normalize() {
            Some(_) => Ok(vector),
            None => Err(de::Error::custom("a direction cannot be [0, 0, 0]")),
        }
    }
}

value! {
    /// An affine map: the images of the x, the y and the z axis as vectors, and of the origin as a point.
    Matrix(DAffine3),
    {
        "type": "array", "minItems": 4, "maxItems": 4,
        "items": { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 }
    },
    |d| {
        let expected = "four vectors: the images of the x, y and z axis and of the origin";
        let [x, y, z, origin] = elements::<Vector, 4, D>(d, expected)?.map(|vector| vector.0);
        let axes = DMat3::from_cols(x, y, z);
        if axes.determinant() == 0.0 {
            return Err(de::Error::custom("the three axes of a matrix lie in one plane"));
        }
        Ok(DAffine3::from_mat3_translation(axes, origin))
    }
}
