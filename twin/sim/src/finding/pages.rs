//! One page per code, printed by `twin explain`.

use super::register::Code;

/// The page of a code.
pub(super) fn page(code: Code) -> &'static str {
    match code {
        Code::R101 => include_str!("pages/R101.md"),
        Code::R102 => include_str!("pages/R102.md"),
        Code::R103 => include_str!("pages/R103.md"),
        Code::R104 => include_str!("pages/R104.md"),
        Code::R105 => include_str!("pages/R105.md"),
        Code::R106 => include_str!("pages/R106.md"),
        Code::R107 => include_str!("pages/R107.md"),
        Code::R108 => include_str!("pages/R108.md"),
        Code::C201 => include_str!("pages/C201.md"),
        Code::C202 => include_str!("pages/C202.md"),
        Code::C203 => include_str!("pages/C203.md"),
        Code::C204 => include_str!("pages/C204.md"),
        Code::C205 => include_str!("pages/C205.md"),
        Code::C206 => include_str!("pages/C206.md"),
        Code::C207 => include_str!("pages/C207.md"),
        Code::C208 => include_str!("pages/C208.md"),
        Code::P301 => include_str!("pages/P301.md"),
        Code::P302 => include_str!("pages/P302.md"),
        Code::P303 => include_str!("pages/P303.md"),
        Code::P304 => include_str!("pages/P304.md"),
        Code::P305 => include_str!("pages/P305.md"),
        Code::P306 => include_str!("pages/P306.md"),
        Code::P307 => include_str!("pages/P307.md"),
        Code::P308 => include_str!("pages/P308.md"),
        Code::P309 => include_str!("pages/P309.md"),
        Code::P310 => include_str!("pages/P310.md"),
        Code::P311 => include_str!("pages/P311.md"),
        Code::S401 => include_str!("pages/S401.md"),
        Code::S402 => include_str!("pages/S402.md"),
        Code::S406 => include_str!("pages/S406.md"),
        Code::S410 => include_str!("pages/S410.md"),
        Code::E501 => include_str!("pages/E501.md"),
        Code::E502 => include_str!("pages/E502.md"),
        Code::E504 => include_str!("pages/E504.md"),
        Code::E508 => include_str!("pages/E508.md"),
        Code::E511 => include_str!("pages/E511.md"),
    }
}
