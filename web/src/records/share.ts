// Shares a link: by the sheet of the device where there is one, else by the clipboard.

export type Shared = 'shared' | 'copied' | 'refused';

export async function share(title: string, url: string): Promise<Shared> {
  const data = { title, url };
  if (navigator.share && matchMedia('(hover: none)').matches) {
    try {
      await navigator.share(data);
      return 'shared';
    } catch (error) {
      // The player closed the sheet.
      if (error instanceof DOMException && error.name === 'AbortError') return 'refused';
    }
  }
  try {
    await navigator.clipboard.writeText(url);
    return 'copied';
  } catch {
    return 'refused';
  }
}
