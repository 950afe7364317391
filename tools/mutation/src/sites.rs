//! Where a file can be made wrong, and how.
//!
//! Each site is rewritten so that every variant of it stands in the same program, chosen by number when it runs.
//! Operands are evaluated once, before the choice, so that sites nest without growing.

use std::collections::{HashMap, HashSet};

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Expr, Item, Lit, Member, Stmt, Token, UnOp};

use crate::edit::{Edit, Site};

/// What a visit finds.
pub struct Found {
    /// All sites, also those whose variants are all dropped.
    pub sites: Vec<Site>,
    /// Edits of the sites that are left.
    pub edits: Vec<Edit>,
}

/// Constants of the crate by name, with the path of the function that stands for each; absent where the name is not unique.
pub type Constants = HashMap<String, String>;

/// Visits one file. `first` is the number of its first variant; `dropped` holds numbers of variants that do not compile,
/// `dropped_sites` the indices of sites that do not.
pub fn find(
    text: &str,
    first: u32,
    constants: &Constants,
    dropped: &HashSet<u32>,
    dropped_sites: &HashSet<usize>,
    faults: &[Fault],
) -> Result<Found, String> {
    let file = syn::parse_file(text).map_err(|e| e.to_string())?;
    let mut visitor = Visitor {
        text,
        faults: faults.iter().map(|fault| (fault, false)).collect(),
        constants,
        dropped,
        dropped_sites,
        next: first,
        depth: 0,
        place: false,
        context: Vec::new(),
        found: Found { sites: Vec::new(), edits: Vec::new() },
    };
    visitor.visit_file(&file);
    match visitor.faults.iter().find(|(_, found)| !found) {
        Some((fault, _)) => Err(format!("no place for the fault: {} ({})", fault.what, fault.function)),
        None => Ok(visitor.found),
    }
}

/// A fault that a physicist makes and no tool: part of a function written otherwise.
pub struct Fault {
    /// The function's name.
    pub function: String,
    /// What stands there.
    pub from: String,
    /// What stands there in the variant.
    pub to: String,
    /// In words.
    pub what: String,
}

/// Names of the modules in files of their own that a file declares for tests alone.
pub fn modules_of_tests(text: &str) -> Result<Vec<String>, String> {
    let file = syn::parse_file(text).map_err(|e| e.to_string())?;
    Ok(file
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Mod(module) if module.content.is_none() && of_tests(&module.attrs) => Some(module.ident.to_string()),
            _ => None,
        })
        .collect())
}

/// Names of the constants that a file defines outside of traits and functions.
pub fn constants(text: &str) -> Result<Vec<String>, syn::Error> {
    let file = syn::parse_file(text)?;
    Ok(file
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Const(c) if c.generics.params.is_empty() && c.ident != "_" => Some(c.ident.to_string()),
            _ => None,
        })
        .collect())
}

/// The name of the function that gives a constant with its variants.
pub fn function_of(constant: &str) -> String {
    format!("{constant}__mutable")
}

struct Visitor<'a> {
    text: &'a str,
    /// Faults of this file, and whether their place was found.
    faults: Vec<(&'a Fault, bool)>,
    constants: &'a Constants,
    dropped: &'a HashSet<u32>,
    dropped_sites: &'a HashSet<usize>,
    next: u32,
    depth: usize,
    /// Whether the expression visited next names a place rather than a value.
    place: bool,
    context: Vec<String>,
    found: Found,
}

/// A variant: what is said of it, and its code.
type Variant = (String, String);

/// A variant that is left: its place at its site, its number in the build, and its code.
type Numbered = (usize, u32, String);

// What is written in place of what, in turn.
const ASSIGNMENTS: &str = "+= -= -= += *= /= /= *=";
const OPERATORS: &str = "+ - - + * / / * % / << >> >> <<";
const FIELDS: &str = "x y y z z x xx yy yy zz zz xx alpha gamma gamma alpha sin cos cos sin re im im re";
/// Methods with so many arguments.
const SWAPPED: &str = "sin/0 cos cos/0 sin sinh/0 cosh cosh/0 sinh floor/0 ceil ceil/0 floor min/1 max max/1 min any/1 all \
    all/1 any is_some/0 is_none is_none/0 is_some is_ok/0 is_err is_err/0 is_ok exp/0 recip";

// Methods that are left out: without arguments, with any; and those of which the sign is changed.
const DROPPED_ALONE: &str = "transpose abs sqrt recip conj round trunc normalize ln rev";
const DROPPED: &str = "powi clamp rem_euclid copysign";
const NEGATED: &str = "cross dot atan2 tan atan asin acos tr_mul component_mul";

/// What follows a word in a list of pairs.
fn beside(pairs: &'static str, word: &str) -> Option<&'static str> {
    let mut words = pairs.split(' ');
    std::iter::from_fn(|| words.next().zip(words.next())).find(|(first, _)| *first == word).map(|(_, second)| second)
}

/// The names of some operands.
fn operands(which: impl IntoIterator<Item = usize>) -> String {
    which.into_iter().map(|k| format!("__{k}")).collect::<Vec<_>>().join(", ")
}

/// The orders of `count` things in which two neighbours are swapped, each with the place of the second.
fn swapped(count: usize) -> impl Iterator<Item = (usize, Vec<usize>)> {
    (1..count).map(move |k| {
        let mut order: Vec<usize> = (0..count).collect();
        order.swap(k - 1, k);
        (k, order)
    })
}

fn range(node: &impl Spanned) -> (usize, usize) {
    let range = node.span().byte_range();
    (range.start, range.end)
}

impl<'a> Visitor<'a> {
    fn raw(&self, node: &impl Spanned) -> &'a str {
        let (start, end) = range(node);
        &self.text[start..end]
    }

    /// Adds a site; its index.
    fn add(&mut self, range: (usize, usize), variants: Vec<String>, function: String) -> usize {
        let (first, line) = (self.next, self.text[..range.0].matches('\n').count() + 1);
        self.next += variants.len() as u32;
        self.found.sites.push(Site { variants, first, line, function, range });
        self.found.sites.len() - 1
    }

    /// Enters a site: its index, and the variants that are left with their numbers.
    fn enter(&mut self, range: (usize, usize), variants: Vec<Variant>) -> Option<(usize, Vec<Numbered>)> {
        if variants.is_empty() {
            return None;
        }
        let first = self.next;
        let labels = variants.iter().map(|(label, _)| label.clone()).collect();
        let index = self.add(range, labels, self.context.join("::"));
        if self.dropped_sites.contains(&index) {
            return None;
        }
        let left: Vec<_> = variants
            .into_iter()
            .enumerate()
            .map(|(k, (_, code))| (k, first + k as u32, code))
            .filter(|(_, number, _)| !self.dropped.contains(number))
            .collect();
        (!left.is_empty()).then_some((index, left))
    }

    fn put(&mut self, site: usize, range: (usize, usize), text: String, closes: bool) {
        self.found.edits.push(Edit { range, text, site, depth: self.depth, closes });
    }

    /// A chain of choices that ends with the code as it was.
    fn choice(variants: &[Numbered], otherwise: &str) -> String {
        let mut text = String::new();
        for (k, number, code) in variants {
            text += &format!("if crate::mutation::active({number}) {{\u{1}{k};{code}\u{2}}} else ");
        }
        text + &format!("{{ {otherwise} }}")
    }

    /// Operands are bound to `__0`, `__1`... and the code chosen works on them.
    fn bind(&mut self, whole: (usize, usize), places: &[(usize, usize)], variants: Vec<Variant>, original: &str) {
        let Some((site, left)) = self.enter(whole, variants) else { return };
        self.put(site, (whole.0, places[0].0), "(match (".into(), false);
        for pair in places.windows(2) {
            self.put(site, (pair[0].1, pair[1].0), ", ".into(), false);
        }
        let close = format!(",) {{ ({},) => {} }})", operands(0..places.len()), Self::choice(&left, original));
        self.put(site, (places[places.len() - 1].1, whole.1), close, true);
    }

    fn inside(&mut self, visit: impl FnOnce(&mut Self)) {
        self.depth += 1;
        visit(self);
        self.depth -= 1;
    }

    /// Visits an expression that names a place, or one that has a value.
    fn visited(&mut self, place: bool, visit: impl FnOnce(&mut Self)) {
        let before = std::mem::replace(&mut self.place, place);
        visit(self);
        self.place = before;
    }

    fn value(&mut self, expr: &Expr) {
        self.visited(false, |v| v.visit_expr(expr));
    }

    fn of_place(&mut self, expr: &Expr) {
        self.visited(true, |v| v.visit_expr(expr));
    }

    /// A site without a variant of its own; its index, if it is left.
    fn plain(&mut self, range: (usize, usize), function: String) -> Option<usize> {
        let index = self.add(range, Vec::new(), function);
        (!self.dropped_sites.contains(&index)).then_some(index)
    }

    /// A site with one variant, of which the code in place follows from its number.
    fn one(&mut self, range: (usize, usize), label: String) -> Option<(usize, String)> {
        let (site, kept) = self.enter(range, vec![(label, String::new())])?;
        Some((site, kept[0].1.to_string()))
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        let whole = range(binary);
        let (left, right) = (range(&binary.left), range(&binary.right));
        let sign = self.raw(&binary.op).to_string();
        if let Some(other) = beside(ASSIGNMENTS, &sign) {
            let place = self.raw(&binary.left).to_string();
            let code = |op: &str| format!("{place} {op} __0;");
            let variants =
                vec![(format!("{sign} -> {other}"), code(other)), (format!("{sign} -> dropped"), String::new())];
            if let Some((site, kept)) = self.enter(whole, variants) {
                self.put(site, (whole.0, right.0), "(match (".into(), false);
                let close = format!(") {{ __0 => {} }})", Self::choice(&kept, &code(&sign)));
                self.put(site, (right.1, whole.1), close, true);
            }
            // The left side is written as it was in every variant.
            return self.inside(|v| v.value(&binary.right));
        }
        if let Some(other) = beside(OPERATORS, &sign) {
            let variants = vec![
                (format!("{sign} -> {other}"), format!("__0 {other} __1")),
                (format!("right of {sign} dropped"), "__0".to_string()),
            ];
            self.bind(whole, &[left, right], variants, &format!("__0 {sign} __1"));
        } else if let Some(other) = beside("&& || || &&", &sign) {
            let has_let = |e: &Expr| e.to_token_stream().into_iter().any(|t| t.to_string() == "let");
            if !has_let(&binary.left)
                && !has_let(&binary.right)
                && let Some((site, number)) = self.one(whole, format!("{sign} -> {other}"))
            {
                // By De Morgan's laws, so that neither side is written twice.
                let flag = format!("crate::mutation::active({number})");
                self.put(site, (whole.0, whole.0), format!("({flag} ^ (({flag} ^ ("), false);
                self.put(site, (left.1, right.0), format!(")) {sign} ({flag} ^ ("), false);
                self.put(site, (right.1, right.1), "))))".into(), true);
            }
        } else if ["<", "<=", ">", ">=", "==", "!="].contains(&sign.as_str())
            && let Some((site, number)) = self.one(whole, format!("{sign} negated"))
        {
            self.put(site, (whole.0, whole.0), format!("(crate::mutation::active({number}) ^ ("), false);
            self.put(site, (whole.1, whole.1), "))".into(), true);
        }
        self.inside(|v| {
            v.value(&binary.left);
            v.value(&binary.right);
        });
    }

    fn literal(&mut self, literal: &syn::ExprLit) {
        let whole = range(literal);
        let raw = self.raw(literal);
        let other = match &literal.lit {
            Lit::Float(f) => {
                let value: f64 = f.base10_digits().parse().expect("a float");
                let new = if value == 0.0 || (1e-3..=1e3).contains(&value.abs()) { value + 1.0 } else { value * 1e3 };
                format!("{new:?}{}", f.suffix())
            }
            Lit::Int(i) => {
                let Ok(value) = i.base10_parse::<u128>() else { return };
                format!("{}{}", value + 1, i.suffix())
            }
            Lit::Bool(b) => format!("{}", !b.value),
            _ => return,
        };
        if let Some((site, number)) = self.one(whole, format!("{raw} -> {other}")) {
            self.put(site, whole, format!("crate::mutation::pick({number}, {raw}, {other})"), false);
        }
    }

    fn call(&mut self, call: &syn::ExprCall) {
        let args: Vec<&Expr> = call.args.iter().collect();
        let name = self.raw(&call.func).to_string();
        let last = name.rsplit("::").next().unwrap_or("").split('<').next().unwrap_or("").trim().to_string();
        let closure = args.iter().any(|a| matches!(a, Expr::Closure(_)));
        let is_path = matches!(*call.func, Expr::Path(_));
        if !args.is_empty() && is_path && !closure && !["Some", "Ok", "Err"].contains(&last.as_str()) {
            let straight = format!("{name}({})", operands(0..args.len()));
            let mut variants = vec![(format!("-{last}(..)"), format!("-{straight}"))];
            variants.extend(swapped(args.len()).map(|(k, order)| {
                let label = format!("{last}: arguments {k} and {} swapped", k + 1);
                (label, format!("{name}({})", operands(order)))
            }));
            let places: Vec<_> = args.iter().map(|a| range(*a)).collect();
            self.bind(range(call), &places, variants, &straight);
        }
        self.inside(|v| args.iter().for_each(|a| v.value(a)));
    }

    fn method(&mut self, call: &syn::ExprMethodCall) {
        let name = call.method.to_string();
        let args: Vec<&Expr> = call.args.iter().collect();
        let list = operands(1..=args.len());
        let variant = |label: &str, code: &str| (format!(".{name}{label}"), code.to_string());
        let among = |names: &str| names.split(' ').any(|known| known == name);
        let mut variants = Vec::new();
        if let Some(other) = beside(SWAPPED, &format!("{name}/{}", args.len())) {
            variants.push(variant(&format!(" -> .{other}"), &format!("__0.{other}({list})")));
        } else if args.is_empty() && among(DROPPED_ALONE) || among(DROPPED) {
            variants.push(variant(" dropped", "__0"));
        } else if among(NEGATED) {
            variants.push((format!("-(.{name})"), format!("-__0.{name}({list})")));
        }
        match (name.as_str(), args.len()) {
            ("sin_cos", 0) => variants.push(variant(" swapped", "{ let (s, c) = __0.sin_cos(); (c, s) }")),
            ("atan2", _) => variants.push(variant(" swapped", "__1.atan2(__0)")),
            ("mul_add", 2) => {
                variants.push(variant(": sum dropped", "__0 * __1"));
                variants.push(variant(": minus", "__0.mul_add(__1, -__2)"));
            }
            _ => {}
        }
        if !variants.is_empty() && call.turbofish.is_none() {
            let places: Vec<_> = std::iter::once(range(&call.receiver)).chain(args.iter().map(|a| range(*a))).collect();
            self.bind(range(call), &places, variants, &format!("__0.{name}({list})"));
        }
        self.inside(|v| {
            v.value(&call.receiver);
            args.iter().for_each(|a| v.value(a));
        });
    }

    fn field(&mut self, field: &syn::ExprField) {
        let mut base = &*field.base;
        while let Expr::Field(inner) = base {
            base = &inner.base;
        }
        let other = match &field.member {
            _ if self.place || !matches!(base, Expr::Path(_)) => None,
            Member::Named(name) => beside(FIELDS, &name.to_string()),
            Member::Unnamed(index) => Some(if index.index == 0 { "1" } else { "0" }),
        };
        let Some(other) = other else { return self.inside(|v| v.of_place(&field.base)) };
        let (raw, base) = (self.raw(field).to_string(), self.raw(&field.base).to_string());
        let variant = (format!("{raw} -> {base}.{other}"), format!("{base}.{other}"));
        if let Some((site, kept)) = self.enter(range(field), vec![variant]) {
            self.put(site, range(field), format!("({})", Self::choice(&kept, &raw)), false);
        }
    }

    fn structure(&mut self, literal: &syn::ExprStruct) {
        let fields: Vec<_> = literal.fields.iter().collect();
        let closure = fields.iter().any(|f| matches!(f.expr, Expr::Closure(_)));
        if literal.rest.is_none() && fields.len() >= 2 && !closure {
            let path = self.raw(&literal.path).to_string();
            let name = |j: usize| fields[j].member.to_token_stream().to_string();
            let write = |order: Vec<usize>| {
                let list: Vec<String> = order.iter().enumerate().map(|(j, k)| format!("{}: __{k}", name(j))).collect();
                format!("{path} {{ {} }}", list.join(", "))
            };
            let variants = swapped(fields.len())
                .map(|(k, order)| (format!("{path}: {} and {} swapped", name(k - 1), name(k)), write(order)))
                .collect();
            let places: Vec<_> = fields.iter().map(|f| range(&f.expr)).collect();
            self.bind(range(literal), &places, variants, &write((0..fields.len()).collect()));
        } else if let Some(rest) = &literal.rest {
            self.inside(|v| v.value(rest));
        }
        self.inside(|v| fields.iter().for_each(|f| v.value(&f.expr)));
    }

    fn constant_used(&mut self, path: &syn::ExprPath) {
        let Some(last) = path.path.segments.last() else { return };
        let Some(function) = self.constants.get(&last.ident.to_string()) else { return };
        // `R::COUNT` is a constant of a type, whose name may be that of another one.
        let is_of_a_type = path
            .path
            .segments
            .iter()
            .nth_back(1)
            .is_some_and(|owner| owner.ident.to_string().starts_with(char::is_uppercase));
        if path.qself.is_some() || is_of_a_type || !matches!(last.arguments, syn::PathArguments::None) {
            return;
        }
        // The variants are in the function.
        if let Some(index) = self.plain(range(path), self.context.join("::")) {
            self.put(index, range(path), format!("{function}()"), false);
        }
    }

    /// A body with a fault in it, in front of the right one.
    fn faulty(&mut self, name: &str, block: &syn::Block) {
        let whole = range(block);
        let raw = self.raw(block).to_string();
        let mut variants = Vec::new();
        for (fault, found) in self.faults.iter_mut().filter(|(fault, _)| fault.function == name) {
            if raw.contains(&fault.from) {
                *found = true;
                let code = format!("return {};", raw.replacen(&fault.from, &fault.to, 1));
                variants.push((format!("{}: {} -> {}", fault.what, fault.from, fault.to), code));
            }
        }
        if let Some((site, left)) = self.enter(whole, variants) {
            let mut text = String::new();
            for (k, number, code) in left {
                text += &format!(" if crate::mutation::active({number}) {{\u{1}{k};{code}\u{2}}}");
            }
            self.put(site, (whole.0 + 1, whole.0 + 1), text, false);
        }
        self.inside(|v| v.visit_block(block));
    }

    fn named(&mut self, name: String, visit: impl FnOnce(&mut Self)) {
        self.context.push(name);
        visit(self);
        self.context.pop();
    }
}

/// Functions that the compiler takes hours over with variants in them, since it searches the types of chained matrix operators.
/// They are left to mutants that are built one by one.
const SKIPPED: [&str; 1] = ["preferred_frame_parameter"];

fn skipped(name: &syn::Ident) -> bool {
    SKIPPED.iter().any(|skipped| name == skipped)
}

fn of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| a.path().is_ident("cfg") && a.meta.to_token_stream().to_string().contains("test"))
}

impl<'ast> Visit<'ast> for Visitor<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Mod(m) if of_tests(&m.attrs) => {}
            Item::Static(_) | Item::Enum(_) | Item::Struct(_) | Item::Type(_) | Item::Use(_) | Item::Macro(_) => {}
            Item::Const(c) if c.ident != "_" && c.generics.params.is_empty() => {
                if !self.constants.contains_key(&c.ident.to_string()) {
                    return;
                }
                // A function with the same value, to be called where the constant is used; the constant itself stays.
                let name = c.ident.to_string();
                let (whole, value) = (range(c), range(&*c.expr));
                let Some(index) = self.plain(whole, name.clone()) else { return };
                let raw = self.raw(c).to_string();
                let head = format!(
                    "{raw}\n#[allow(non_snake_case)] #[inline] pub(crate) fn {}() -> {} {{ ",
                    function_of(&name),
                    self.raw(&*c.ty)
                );
                self.put(index, (whole.0, value.0), head, false);
                self.put(index, (value.1, whole.1), " }".into(), true);
                self.named(name, |v| v.inside(|v| v.value(&c.expr)));
            }
            Item::Fn(f) if f.sig.constness.is_some() || of_tests(&f.attrs) || skipped(&f.sig.ident) => {}
            Item::Impl(i) => {
                let name = i.self_ty.to_token_stream().to_string().replace(' ', "");
                self.named(name, |v| visit::visit_item_impl(v, i));
            }
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        let name = f.sig.ident.to_string();
        self.named(name.clone(), |v| v.faulty(&name, &f.block));
    }

    fn visit_impl_item_fn(&mut self, f: &'ast syn::ImplItemFn) {
        if f.sig.constness.is_none() && f.sig.ident != "fmt" && !of_tests(&f.attrs) {
            let name = f.sig.ident.to_string();
            self.named(name.clone(), |v| v.faulty(&name, &f.block));
        }
    }

    fn visit_trait_item_fn(&mut self, f: &'ast syn::TraitItemFn) {
        if let Some(block) = &f.default {
            self.named(f.sig.ident.to_string(), |v| v.visit_block(block));
        }
    }

    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.inside(|v| v.value(&repeat.expr));
    }

    fn visit_stmt(&mut self, stmt: &'ast Stmt) {
        if let Stmt::Expr(expr, Some(_)) = stmt {
            let what = match expr {
                // Of what is borrowed the compiler asks it.
                Expr::Call(call) if matches!(&*call.func, Expr::Path(f) if f.path.is_ident("drop")) => "",
                Expr::MethodCall(_) | Expr::Call(_) => "call dropped",
                Expr::Assign(_) => "assignment dropped",
                _ => "",
            };
            if !what.is_empty() {
                let whole = range(stmt);
                let shown: String = self.raw(stmt).chars().take(60).collect();
                if let Some((site, number)) = self.one(whole, format!("{what}: {shown}")) {
                    let open = format!("if !crate::mutation::active({number}) {{ ");
                    self.put(site, (whole.0, whole.0), open, false);
                    self.put(site, (whole.1, whole.1), " }".into(), true);
                }
                return self.inside(|v| visit::visit_stmt(v, stmt));
            }
        }
        visit::visit_stmt(self, stmt);
    }

    fn visit_macro(&mut self, mac: &'ast syn::Macro) {
        if mac.path.is_ident("vec")
            && let Ok(list) = mac.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated)
        {
            self.inside(|v| list.iter().for_each(|e| v.value(e)));
        }
    }

    fn visit_expr(&mut self, expr: &'ast Expr) {
        match expr {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Lit(literal) => self.literal(literal),
            Expr::Call(call) => self.call(call),
            Expr::MethodCall(call) => self.method(call),
            Expr::Field(field) => self.field(field),
            Expr::Struct(literal) => self.structure(literal),
            Expr::Path(path) => self.constant_used(path),
            Expr::Unary(unary) => {
                if matches!(unary.op, UnOp::Deref(_)) {
                    return self.inside(|v| v.of_place(&unary.expr));
                }
                let sign = self.raw(&unary.op);
                let variant = (format!("{sign} dropped"), "__0".to_string());
                self.bind(range(unary), &[range(&*unary.expr)], vec![variant], &format!("{sign}__0"));
                self.inside(|v| v.value(&unary.expr));
            }
            Expr::Reference(reference) => self.inside(|v| v.of_place(&reference.expr)),
            Expr::Assign(assign) => self.inside(|v| {
                v.of_place(&assign.left);
                v.value(&assign.right);
            }),
            Expr::Index(index) => self.inside(|v| {
                v.of_place(&index.expr);
                v.value(&index.index);
            }),
            _ => self.inside(|v| v.visited(false, |v| visit::visit_expr(v, expr))),
        }
    }
}
