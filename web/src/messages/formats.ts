// Numbers, plurals and lists in a language. Units are symbols of the SI, which all languages share.

export interface Formats {
  /** A number with so many decimals. */
  decimal(value: number, digits: number): string;
  /** A number with at most so many significant figures. */
  significant(value: number, digits: number): string;
  /** A whole number, in groups from five digits on. */
  count(value: number): string;
  /** The form for a number. */
  plural(value: number, forms: Plurals): string;
  /** A list joined as in a sentence. */
  list(items: readonly string[]): string;
}

/** Forms of a phrase by the number in it; languages differ in which of them they have. */
export type Plurals = Partial<Record<Intl.LDMLPluralRule, string>> & { other: string };

/** Returns the formats of a language (BCP 47). */
export function formatsOf(language: string): Formats {
  const numbers = new Map<string, Intl.NumberFormat>();
  // A format takes a hundred times as long to create as to use.
  const numberFormat = (key: string, options: Intl.NumberFormatOptions) => {
    let format = numbers.get(key);
    if (!format) numbers.set(key, (format = new Intl.NumberFormat(language, { useGrouping: false, ...options })));
    return format;
  };
  const rules = new Intl.PluralRules(language);
  const lists = new Intl.ListFormat(language, { type: 'conjunction' });
  return {
    decimal: (value, digits) =>
      numberFormat(`d${digits}`, { minimumFractionDigits: digits, maximumFractionDigits: digits }).format(value),
    significant: (value, digits) => numberFormat(`s${digits}`, { maximumSignificantDigits: digits }).format(value),
    count: value => grouped(numberFormat('c', { maximumFractionDigits: 0 }).format(value)),
    plural: (value, forms) => forms[rules.select(value)] ?? forms.other,
    list: items => lists.format(items),
  };
}

/** Separates groups of three digits by narrow spaces, as ISO 80000 asks for in any language. */
function grouped(digits: string): string {
  return digits.length < 5 ? digits : digits.replace(/\B(?=(\d{3})+$)/g, '\u202f');
}
