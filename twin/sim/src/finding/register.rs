//! The register of finding codes: only what is implemented stands here.

/// A family of codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Reach and motion.
    Reach,
    /// Clearance.
    Clearance,
    /// Process.
    Process,
    /// Structure.
    Structure,
    /// Program and controller.
    Program,
}

impl Family {
    /// All families, in the order of the score.
    pub const ALL: [Self; 5] =
        [Self::Reach, Self::Clearance, Self::Process, Self::Structure, Self::Program];

    /// The letter its codes begin with.
    pub fn letter(self) -> char {
        match self {
            Self::Reach => 'R',
            Self::Clearance => 'C',
            Self::Process => 'P',
            Self::Structure => 'S',
            Self::Program => 'E',
        }
    }

    /// What it is about.
    pub fn title(self) -> &'static str {
        match self {
            Self::Reach => "reach and motion",
            Self::Clearance => "clearance",
            Self::Process => "process",
            Self::Structure => "structure",
            Self::Program => "program",
        }
    }
}

/// Which side of the limit is good.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// Measured must not exceed the limit.
    Upper,
    /// Measured must not fall below the limit.
    Lower,
    /// The thing must not happen.
    Forbidden,
}

/// A stable code. Its page is printed by `twin explain`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "`title` and `page` say what each one is")]
pub enum Code {
    R101,
    R102,
    R103,
    R104,
    R105,
    R106,
    R107,
    R108,
    C201,
    C202,
    C203,
    C204,
    C205,
    C206,
    C207,
    C208,
    P301,
    P302,
    P303,
    P304,
    P305,
    P306,
    P307,
    P308,
    P309,
    P310,
    P311,
    S401,
    S402,
    S403,
    S404,
    S405,
    S406,
    S407,
    S408,
    S409,
    S410,
    E501,
    E502,
    E504,
    E508,
    E511,
}

impl Code {
    /// Every code, in order.
    pub const ALL: [Self; 42] = [
        Self::R101,
        Self::R102,
        Self::R103,
        Self::R104,
        Self::R105,
        Self::R106,
        Self::R107,
        Self::R108,
        Self::C201,
        Self::C202,
        Self::C203,
        Self::C204,
        Self::C205,
        Self::C206,
        Self::C207,
        Self::C208,
        Self::P301,
        Self::P302,
        Self::P303,
        Self::P304,
        Self::P305,
        Self::P306,
        Self::P307,
        Self::P308,
        Self::P309,
        Self::P310,
        Self::P311,
        Self::S401,
        Self::S402,
        Self::S403,
        Self::S404,
        Self::S405,
        Self::S406,
        Self::S407,
        Self::S408,
        Self::S409,
        Self::S410,
        Self::E501,
        Self::E502,
        Self::E504,
        Self::E508,
        Self::E511,
    ];

    /// The code as users write it.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::R101 => "R101",
            Self::R102 => "R102",
            Self::R103 => "R103",
            Self::R104 => "R104",
            Self::R105 => "R105",
            Self::R106 => "R106",
            Self::R107 => "R107",
            Self::R108 => "R108",
            Self::C201 => "C201",
            Self::C202 => "C202",
            Self::C203 => "C203",
            Self::C204 => "C204",
            Self::C205 => "C205",
            Self::C206 => "C206",
            Self::C207 => "C207",
            Self::C208 => "C208",
            Self::P301 => "P301",
            Self::P302 => "P302",
            Self::P303 => "P303",
            Self::P304 => "P304",
            Self::P305 => "P305",
            Self::P306 => "P306",
            Self::P307 => "P307",
            Self::P308 => "P308",
            Self::P309 => "P309",
            Self::P310 => "P310",
            Self::P311 => "P311",
            Self::S401 => "S401",
            Self::S402 => "S402",
            Self::S403 => "S403",
            Self::S404 => "S404",
            Self::S405 => "S405",
            Self::S406 => "S406",
            Self::S407 => "S407",
            Self::S408 => "S408",
            Self::S409 => "S409",
            Self::S410 => "S410",
            Self::E501 => "E501",
            Self::E502 => "E502",
            Self::E504 => "E504",
            Self::E508 => "E508",
            Self::E511 => "E511",
        }
    }

    /// The code of this name, if there is one.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|code| code.as_str().eq_ignore_ascii_case(name))
    }

    /// The family it belongs to.
    pub fn family(self) -> Family {
        let letter = self.as_str().chars().next();
        Family::ALL
            .into_iter()
            .find(|family| Some(family.letter()) == letter)
            .expect("every letter is a family")
    }

    /// What it is, in a few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::R101 => "pose out of reach",
            Self::R102 => "too near a joint limit",
            Self::R103 => "too near a singularity",
            Self::R104 => "branch flip inside a strand",
            Self::R105 => "joint too slow for the print speed",
            Self::R106 => "drive too weak for the motion",
            Self::R107 => "TCP leaves the strand",
            Self::R108 => "TCP faster or slower than asked",
            Self::C201 => "nozzle too near printed strands",
            Self::C202 => "tool too near printed strands",
            Self::C203 => "arm too near printed strands",
            Self::C204 => "nozzle too near the strand in progress",
            Self::C205 => "tool, arm or bed too near bed, form or fixtures",
            Self::C206 => "arm or tool too near the arm itself",
            Self::C207 => "no collision-free transit found",
            Self::C208 => "bead laid through an earlier one",
            Self::P301 => "strand sags behind the nozzle",
            Self::P302 => "strand over-fed or over-drawn",
            Self::P303 => "set strand sags under its own weight",
            Self::P304 => "shrinkage moves the free end",
            Self::P305 => "core of the strand stays uncured",
            Self::P306 => "strand sets too far behind the nozzle",
            Self::P307 => "bead too wide or too narrow",
            Self::P308 => "light cures resin on the nozzle",
            Self::P309 => "strand laid against the rules of the process",
            Self::P310 => "bond at a node too weak",
            Self::P311 => "prime, overrun or dwell missing",
            Self::S401 => "node is not where the nozzle expects it",
            Self::S402 => "strand printed on nothing",
            Self::S403 => "member strained too far while printing",
            Self::S404 => "growing frame near buckling",
            Self::S405 => "node strained too far while printing",
            Self::S406 => "finished part gives way under its loads",
            Self::S407 => "finished part yields under its loads",
            Self::S408 => "finished part collapses under its loads",
            Self::S409 => "part shakes on the moving bed",
            Self::S410 => "part lets go of bed or form",
            Self::E501 => "too much on the flange",
            Self::E502 => "hose pulled or twisted too far",
            Self::E504 => "program takes too long",
            Self::E508 => "calibration leaves too much doubt",
            Self::E511 => "material waits too long",
        }
    }

    /// Which side of the limit is good.
    pub fn bound(self) -> Bound {
        match self {
            Self::R101 | Self::R104 | Self::C207 | Self::S402 => Bound::Forbidden,
            Self::R102
            | Self::C201
            | Self::C202
            | Self::C203
            | Self::C204
            | Self::C205
            | Self::C206
            | Self::P310
            | Self::P311
            | Self::S404
            | Self::S407
            | Self::S408 => Bound::Lower,
            _ => Bound::Upper,
        }
    }

    /// Unit of measured value and limit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::R101
            | Self::R103
            | Self::R104
            | Self::R105
            | Self::R106
            | Self::R108
            | Self::C207
            | Self::S402
            | Self::S403
            | Self::S404
            | Self::S405
            | Self::S407
            | Self::S408
            | Self::S410
            | Self::C208
            | Self::P302
            | Self::P307
            | Self::P308
            | Self::P309
            | Self::P311
            | Self::E502 => "1",
            Self::R102 => "rad",
            Self::E501 => "kg",
            Self::E504 | Self::E511 => "s",
            Self::P310 => "N",
            _ => "m",
        }
    }

    /// The page printed by `twin explain`.
    pub fn page(self) -> &'static str {
        super::pages::page(self)
    }
}
