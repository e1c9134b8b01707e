//! Joints that stay put become part of the fixed transforms.

use super::chain::{Chain, ChainFault, ChainJoint, Mimic, advance};
use crate::pose::Pose;

impl Chain {
    /// The chain with the named joints fixed at their values, rad or m; followers are fixed with
    /// their masters. Limits of held joints are not looked at.
    pub fn hold(&self, values: &[(&str, f64)]) -> Result<Self, ChainFault> {
        let held = self.held_by_axis(values)?;
        let mut joints: Vec<ChainJoint> = Vec::with_capacity(self.joints().len());
        let mut new_index = vec![usize::MAX; self.joints().len()];
        let mut carried = Pose::identity();
        for (index, (joint, drive)) in self.joints().iter().zip(&self.drives).enumerate() {
            carried *= joint.parent_from_joint;
            if let Some(value) = held[drive.axis] {
                advance(&mut carried, joint, drive.multiplier * value + drive.offset);
                continue;
            }
            new_index[index] = joints.len();
            // Masters are written down by their old index here and renamed below.
            let mimic = joint.mimic.map(|_| Mimic {
                master: self.axes()[drive.axis].joint,
                multiplier: drive.multiplier,
                offset: drive.offset,
            });
            joints.push(ChainJoint { parent_from_joint: carried, mimic, ..joint.clone() });
            carried = Pose::identity();
        }
        for joint in &mut joints {
            if let Some(mimic) = &mut joint.mimic {
                mimic.master = new_index[mimic.master];
            }
        }
        Self::new(joints, carried * self.last_from_tip())
    }

    fn held_by_axis(&self, values: &[(&str, f64)]) -> Result<Vec<Option<f64>>, ChainFault> {
        let mut held = vec![None; self.dof()];
        for &(name, value) in values {
            let Some(index) = self.joints().iter().position(|joint| joint.name == name) else {
                return Err(ChainFault::UnknownJoint { joint: name.to_owned() });
            };
            let drive = &self.drives[index];
            if self.joints()[index].mimic.is_some() {
                return Err(ChainFault::MimicHeld {
                    joint: name.to_owned(),
                    master: self.axis_name(drive.axis).to_owned(),
                });
            }
            held[drive.axis] = Some(value);
        }
        Ok(held)
    }
}
