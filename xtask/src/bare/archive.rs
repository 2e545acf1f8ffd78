//! What a static library is made of: sections of object files, and what each refers to.
//!
//! Compilers put every function and every constant into a section of its own, and whatever one needs of another is a
//! relocation. So the sections are the nodes of a graph, relocations its edges, and nothing that can be executed
//! is missing from it.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use object::read::archive::ArchiveFile;
use object::{
    Architecture, Object, ObjectSection, ObjectSymbol, RelocationTarget, SectionIndex, SectionKind,
    SymbolIndex,
};

/// Sections of every object file of a library.
#[derive(Debug, Default)]
pub struct Archive {
    /// The nodes.
    pub sections: Vec<Section>,
    /// Section of each exported or shared symbol.
    globals: HashMap<String, usize>,
}

/// A function, or a constant.
#[derive(Debug, Default)]
pub struct Section {
    /// Names of what begins here.
    pub names: Vec<String>,
    /// Machine code, otherwise data.
    pub is_code: bool,
    /// Bytes.
    pub size: u64,
    /// Bytes of the stack frame, for a function whose compiler noted it.
    pub stack: Option<u64>,
    /// Sections of the same library that it refers to.
    pub references: BTreeSet<usize>,
    /// What it refers to that is not in the library.
    pub externals: BTreeSet<String>,
}

use super::thumb;

type Result<T> = std::result::Result<T, object::Error>;

impl Archive {
    /// From the bytes of a static library.
    pub fn parse(bytes: &[u8]) -> Result<Self> {
        let archive = ArchiveFile::parse(bytes)?;
        let mut files = Vec::new();
        for member in archive.members() {
            let data = member?.data(bytes)?;
            // Rust's own metadata lie among the object files.
            if let Ok(file) = object::File::parse(data) {
                files.push(file);
            }
        }
        let mut result = Self::default();
        let starts: Vec<HashMap<SectionIndex, usize>> = files.iter().map(|file| result.add(file)).collect();
        for (file, sections) in files.iter().zip(&starts) {
            result.connect(file, sections)?;
        }
        Ok(result)
    }

    /// The section where a global symbol begins.
    pub fn global(&self, name: &str) -> Option<usize> {
        self.globals.get(name).copied()
    }

    /// Global symbols that begin with `prefix`, sorted.
    pub fn globals(&self, prefix: &str) -> Vec<(&str, usize)> {
        let mut found: Vec<_> = self
            .globals
            .iter()
            .filter(|(name, _)| name.starts_with(prefix))
            .map(|(name, section)| (name.as_str(), *section))
            .collect();
        found.sort_unstable();
        found
    }

    /// Adds the sections of a file, without their edges; where each of them stands.
    fn add(&mut self, file: &object::File<'_>) -> HashMap<SectionIndex, usize> {
        let mut places = HashMap::new();
        for section in file.sections() {
            let is_code = section.kind() == SectionKind::Text;
            let is_data = matches!(
                section.kind(),
                SectionKind::ReadOnlyData
                    | SectionKind::ReadOnlyDataWithRel
                    | SectionKind::ReadOnlyString
                    | SectionKind::Data
                    | SectionKind::UninitializedData
            );
            if is_code || is_data {
                places.insert(section.index(), self.sections.len());
                self.sections.push(Section { is_code, size: section.size(), ..Section::default() });
            }
        }
        for symbol in file.symbols() {
            let place = symbol.section_index().and_then(|index| places.get(&index));
            if let (Some(&place), Ok(name)) = (place, symbol.name()) {
                // Names with a dollar mark where an ARM function switches to data.
                if symbol.is_definition() && !name.is_empty() && !name.starts_with('$') {
                    self.sections[place].names.push(format!("{:#}", rustc_demangle::demangle(name)));
                    if symbol.is_global() {
                        self.globals.insert(name.to_owned(), place);
                    }
                }
            }
        }
        places
    }

    /// Adds edges and stack frames of a file's sections.
    fn connect(&mut self, file: &object::File<'_>, places: &HashMap<SectionIndex, usize>) -> Result<()> {
        for section in file.sections() {
            if section.name() == Ok(".stack_sizes") {
                self.read_stack_sizes(file, &section, places)?;
            }
            let Some(&from) = places.get(&section.index()) else { continue };
            if file.architecture() == Architecture::Arm && self.sections[from].is_code {
                let relocated: BTreeSet<u64> = section.relocations().map(|(offset, _)| offset).collect();
                // A call that needs no relocation stays within the section, which is one function.
                if thumb::calls(section.data()?, &data_regions(file, section.index()))
                    .iter()
                    .any(|call| !relocated.contains(call))
                {
                    self.sections[from].references.insert(from);
                }
            }
            for (_, relocation) in section.relocations() {
                let RelocationTarget::Symbol(symbol) = relocation.target() else { continue };
                match self.place(file, symbol, places)? {
                    Ok(to) => {
                        self.sections[from].references.insert(to);
                    }
                    Err(name) => {
                        self.sections[from].externals.insert(name);
                    }
                }
            }
        }
        Ok(())
    }

    /// Where a symbol begins, or its name if that is not in the library.
    fn place(
        &self,
        file: &object::File<'_>,
        symbol: SymbolIndex,
        places: &HashMap<SectionIndex, usize>,
    ) -> Result<std::result::Result<usize, String>> {
        let symbol = file.symbol_by_index(symbol)?;
        let local = symbol.section_index().and_then(|index| places.get(&index));
        let name = symbol.name()?;
        Ok(local.copied().or_else(|| self.global(name)).ok_or_else(|| name.to_owned()))
    }

    /// Records of `.stack_sizes`: the address of a function, as a relocation, then the size of its frame in LEB128.
    fn read_stack_sizes(
        &mut self,
        file: &object::File<'_>,
        section: &object::Section<'_, '_>,
        places: &HashMap<SectionIndex, usize>,
    ) -> Result<()> {
        let data = section.data()?;
        let address_size = if file.is_64() { 8 } else { 4 };
        for (offset, relocation) in section.relocations() {
            let RelocationTarget::Symbol(symbol) = relocation.target() else { continue };
            let bytes = usize::try_from(offset).ok().and_then(|offset| data.get(offset + address_size..));
            let (Ok(place), Some(bytes)) = (self.place(file, symbol, places)?, bytes) else { continue };
            let frame = leb128(bytes);
            let section = &mut self.sections[place];
            section.stack = Some(section.stack.map_or(frame, |other| other.max(frame)));
        }
        Ok(())
    }
}

/// Where data lie within the code of a section: begin and end. ARM marks them by symbols `$d`, code by `$t`.
fn data_regions(file: &object::File<'_>, section: SectionIndex) -> Vec<Range<u64>> {
    let mut marks: Vec<(u64, bool)> = file
        .symbols()
        .filter(|symbol| symbol.section_index() == Some(section))
        .filter_map(|symbol| match symbol.name() {
            Ok(name) if name.starts_with("$d") => Some((symbol.address(), true)),
            Ok(name) if name.starts_with("$t") => Some((symbol.address(), false)),
            _ => None,
        })
        .collect();
    marks.sort_unstable();
    let ends = marks.iter().skip(1).map(|mark| mark.0).chain([u64::MAX]);
    marks.iter().zip(ends).filter(|(mark, _)| mark.1).map(|(mark, end)| mark.0..end).collect()
}

/// An unsigned number: seven bits per byte, least significant first, the eighth bit set where another byte follows.
pub(super) fn leb128(bytes: &[u8]) -> u64 {
    let mut value = 0;
    for (position, byte) in bytes.iter().take(9).enumerate() {
        value |= u64::from(byte & 0x7f) << (7 * position);
        if byte & 0x80 == 0 {
            break;
        }
    }
    value
}
