// Takes a recording home: fetched first, so that a refusal can be shown and not only a download that failed.

import { addressOf } from "./names";

/** Why there is none; "": the browser has it. */
export async function download(file: string): Promise<string> {
  let answer: Response;
  try {
    answer = await fetch(addressOf(file, location.search));
  } catch {
    return "the studio does not answer";
  }
  if (!answer.ok) return (await answer.text()) || `${file} is not to be had`;
  const address = URL.createObjectURL(await answer.blob());
  const link = document.createElement("a");
  Object.assign(link, { href: address, download: file });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
  return "";
}
