//! Whole-program tests: scenarios with their expectations, broken input, the reference data, and
//! the rules of the house that the compiler cannot see.

#[cfg(test)]
mod broken;
#[cfg(test)]
mod by_hand;
#[cfg(test)]
mod invariance;
#[cfg(test)]
mod invariance_process;
#[cfg(test)]
mod isolated;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod outputs;
#[cfg(test)]
mod peers;
#[cfg(test)]
mod pictures;
#[cfg(test)]
mod planted;
#[cfg(test)]
mod planted_process;
#[cfg(test)]
mod planted_structure;
#[cfg(test)]
mod planting;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod reheated;
#[cfg(test)]
mod scenarios;
#[cfg(test)]
mod tidy;
#[cfg(test)]
mod tools;
