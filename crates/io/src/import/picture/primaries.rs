//! Colour spaces by their primaries, and the way from them to linear Rec. 709.

use super::opened::Ignored;
use glam::{DMat3, DVec2, DVec3, Mat3};

/// The chromaticities (x, y in CIE 1931) of a colour space of three primaries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Primaries {
    pub red: DVec2,
    pub green: DVec2,
    pub blue: DVec2,
    pub white: DVec2,
}

/// ITU-R BT.709.
const REC709: Primaries = Primaries {
    red: DVec2::new(0.64, 0.33),
    green: DVec2::new(0.3, 0.6),
    blue: DVec2::new(0.15, 0.06),
    white: DVec2::new(0.3127, 0.329),
};

/// The cone responses of Bradford's adaptation from XYZ (Lam, Metamerism and Colour Constancy, 1985).
const CONES_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

/// The distance of chromaticities that counts as none.
const NEAR: f64 = 5e-4;

impl Primaries {
    /// X, Y and Z of a chromaticity whose three add up to 1.
    fn xyz(point: DVec2) -> DVec3 {
        point.extend(1.0 - point.x - point.y)
    }

    /// To XYZ with Y = 1 for white (SMPTE RP 177). `None` if the primaries are no triangle around a white.
    fn xyz_from_own(&self) -> Option<DMat3> {
        let primaries = DMat3::from_cols(
            Self::xyz(self.red),
            Self::xyz(self.green),
            Self::xyz(self.blue),
        );
        let scale = primaries.inverse() * self.white_xyz();
        let is_usable = primaries.determinant().abs() > 1e-6 && scale.min_element() > 0.0;
        (is_usable && scale.is_finite()).then(|| primaries * DMat3::from_diagonal(scale))
    }

    fn white_xyz(&self) -> DVec3 {
        Self::xyz(self.white) / self.white.y
    }

    fn is_near(&self, other: &Self) -> bool {
        let near = |a: DVec2, b: DVec2| (a - b).abs().max_element() < NEAR;
        near(self.red, other.red)
            && near(self.green, other.green)
            && near(self.blue, other.blue)
            && near(self.white, other.white)
    }
}

/// From XYZ to linear Rec. 709, whose white has Y = 1.
pub(super) fn rec709_from_xyz() -> Mat3 {
    let xyz_from_rec709 = REC709.xyz_from_own().unwrap_or(DMat3::IDENTITY);
    xyz_from_rec709.inverse().as_mat3()
}

/// From colours of these primaries to linear Rec. 709: white stays white. `None` if they are that, or if they are no colour
/// space, which is added to `ignored`; messages call them `name`.
pub(super) fn rec709_from(own: Primaries, name: &str, ignored: &mut Vec<Ignored>) -> Option<Mat3> {
    if own.is_near(&REC709) {
        return None;
    }
    let Some(xyz_from_own) = own.xyz_from_own() else {
        ignored.push(Ignored {
            clause: format!("has {name} that are no colour space: Rec. 709 is assumed"),
            is_of_colors: true,
        });
        return None;
    };
    let cones = |primaries: &Primaries| CONES_FROM_XYZ * primaries.white_xyz();
    let adapted = DMat3::from_diagonal(cones(&REC709) / cones(&own));
    let adapted = CONES_FROM_XYZ.inverse() * adapted * CONES_FROM_XYZ;
    let rec709_from_xyz = REC709.xyz_from_own()?.inverse();
    Some((rec709_from_xyz * adapted * xyz_from_own).as_mat3())
}
