//! Masses and inertias that a rigid body can have.

use super::xml::Element;
use crate::Diagnostic;

/// How far published moments may miss by rounding, as a share of the largest.
const ROUNDING: f64 = 5e-3;

/// Every `<inertial>` of a link that no rigid body has; its numbers have been read before.
///
/// Law: the principal moments of a body are sums of squares, `I₁ = Σ m (y² + z²)` and so on, so
/// none is negative and none exceeds the sum of the other two. Both hold where the smallest
/// principal moment and half the trace minus the largest are not negative. A mass of 0 with no
/// inertia states no mass.
pub(super) fn check(elements: &[Element<'_>]) -> Vec<Diagnostic> {
    let is_link =
        |index: usize| elements[index].name == "link" && elements[index].parent == Some(0);
    let mut problems = Vec::new();
    for (index, element) in elements.iter().enumerate() {
        if element.name == "inertial" && element.parent.is_some_and(is_link) {
            problems.extend(inertial(elements, index));
        }
    }
    problems
}

fn inertial(elements: &[Element<'_>], index: usize) -> Option<Diagnostic> {
    let child =
        |name: &str| elements.iter().find(|each| each.parent == Some(index) && each.name == name);
    let number = |element: &Element<'_>, name: &str| {
        element.attribute(name).and_then(|attribute| attribute.value.trim().parse::<f64>().ok())
    };
    let (mass, inertia) = (child("mass")?, child("inertia")?);
    let mass_kg = number(mass, "value")?;
    let moments: Vec<f64> = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
        .iter()
        .filter_map(|name| number(inertia, name))
        .collect();
    let moments: [f64; 6] = moments.try_into().ok()?;
    if !(mass_kg > 0.0) {
        return moments.iter().any(|&moment| moment != 0.0).then(|| {
            Diagnostic::error(mass.span, "a body with inertia has a mass above 0")
                .hint("leave <inertial> out where the mass is not known")
        });
    }
    let [least, middle, greatest] = principal(moments);
    let slack = ROUNDING * greatest;
    if least >= -slack && least + middle >= greatest - slack {
        return None;
    }
    let message = format!(
        "no body has principal moments of {least:.4}, {middle:.4} and {greatest:.4} kg m²: each is \
         at most the sum of the other two, and none is negative"
    );
    let hint =
        "moments are about the centre of mass, in kg m²; products of inertia have URDF's sign";
    Some(Diagnostic::error(inertia.span, message).hint(hint))
}

/// Eigenvalues of a symmetric matrix, rising: Smith, "Eigenvalues of a symmetric 3 × 3 matrix",
/// Comm. ACM 4 (1961).
fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
    let mean = (xx + yy + zz) / 3.0;
    let [a, b, c] = [xx - mean, yy - mean, zz - mean];
    let off = xy * xy + xz * xz + yz * yz;
    let spread = ((a * a + b * b + c * c + 2.0 * off) / 6.0).sqrt();
    if !(spread > 0.0) {
        return [mean; 3];
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    let half = (determinant / (2.0 * spread * spread * spread)).clamp(-1.0, 1.0);
    let angle = half.acos() / 3.0;
    let third = std::f64::consts::TAU / 3.0;
    let greatest = mean + 2.0 * spread * angle.cos();
    let least = mean + 2.0 * spread * (angle + third).cos();
    [least, 3.0 * mean - greatest - least, greatest]
}
